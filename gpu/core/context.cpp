#include "gpu/core/context.h"

#include <algorithm>
#include <chrono>

#include "gpu/core/vulkan_state.h"

namespace parity::gpu {
namespace {

constexpr std::size_t staging_bytes = std::size_t{4} << 20;

std::unique_ptr<ValidationLog> make_log(const ContextOptions& options) {
  return options.validation ? std::make_unique<ValidationLog>() : nullptr;
}

OwnedSampler make_nearest_sampler(const DeviceLink& link) {
  VkSamplerCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
  info.addressModeU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  info.addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  info.maxLod = VK_LOD_CLAMP_NONE;
  return create<OwnedSampler>(link, vkCreateSampler, info, "vkCreateSampler");
}

void choose(ContextState& state) {
  const std::vector<VkPhysicalDevice> physicals = state.instance->devices();
  std::vector<DeviceInfo> infos;
  for (VkPhysicalDevice each : physicals)
    infos.push_back(describe(each, static_cast<int>(infos.size())));
  const auto chosen = static_cast<std::size_t>(choose_device(infos, state.options.device));
  state.info = infos[chosen];
  state.physical = physicals[chosen];
}

/// Leaves a device that was given up on as it is.
void abandon(std::unique_ptr<ContextState>& state) {
  if (state->link().abandoned) static_cast<void>(state.release());
}

void find_clock(ContextState& state) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(state.physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(state.physical, &count, families.data());
  const std::uint32_t bits = families[state.queue_family].timestampValidBits;
  state.info.timestamps = bits > 0;
  state.tick_mask = bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
  state.seconds_per_tick = static_cast<double>(state.properties.limits.timestampPeriod) * 1e-9;
}

Timing timing_of(const ContextState& state, const std::vector<std::uint64_t>& ticks,
                 const std::vector<std::string>& passes) {
  const auto seconds = [&](std::size_t from, std::size_t to) {
    return static_cast<double>((ticks[to] - ticks[from]) & state.tick_mask) *
           state.seconds_per_tick;
  };
  Timing timing;
  timing.seconds = seconds(0, ticks.size() - 1);
  for (std::size_t i = 0; i < passes.size(); ++i)
    timing.passes.emplace_back(passes[i], seconds(i + 1, i + 2));
  return timing;
}

}  // namespace

ContextState::ContextState(const ContextOptions& context_options,
                           std::unique_ptr<ValidationLog> validation_log)
    : options(context_options), log(std::move(validation_log)) {
  bool gpu_assisted = false;
  if (log != nullptr && options.gpu_assisted) {
    // Whether the layer errs depends on the device, so that is looked up first.
    instance.emplace(nullptr, false);
    choose(*this);
    gpu_assisted = can_assist(info);
    instance.reset();
  }
  instance.emplace(log.get(), gpu_assisted);
  choose(*this);
  if (options.guard == Guard::fences && !info.host_memory_import)
    throw Error(ErrorKind::missing_feature,
                "device " + info.name + " cannot fence buffers: it lacks " +
                    VK_EXT_EXTERNAL_MEMORY_HOST_EXTENSION_NAME + " or is no CPU");
  vkGetPhysicalDeviceProperties(physical, &properties);
  queue_family = find_queue_family(physical).value();
  find_clock(*this);
  staged = options.force_staging || (info.type != "cpu" && info.type != "integrated");
  device.emplace(physical, info);
  memory.emplace(link(), physical);
  submission.emplace(device->link, queue_family, options.timeout_seconds);
  nearest.emplace(make_nearest_sampler(link()));
  if (staged) staging = make_buffer(*this, staging_bytes, MemoryUse::staging);
}

void ContextState::count_bytes(std::uint64_t bytes) {
  memory_bytes += bytes;
  peak_memory_bytes = std::max(peak_memory_bytes, memory_bytes);
}

Context::Context(const ContextOptions& options)
    : state_(std::make_unique<ContextState>(options, make_log(options))) {
  try {
    state_->info.cuts_loops_short = cuts_loops_short(*this);
    drop_unused_pipelines();  // the canary
  } catch (...) {
    abandon(state_);
    throw;
  }
}

Context::~Context() { abandon(state_); }

const DeviceInfo& Context::info() const { return state_->info; }
const ContextOptions& Context::options() const { return state_->options; }
std::uint64_t Context::memory_bytes() const { return state_->memory_bytes; }
std::uint64_t Context::peak_memory_bytes() const { return state_->peak_memory_bytes; }

double Context::device_seconds() const { return state_->device_seconds; }

std::size_t Context::pipeline_count() const {
  return state_->kernels.size() + state_->raster_pipelines.size();
}

void Context::drop_unused_pipelines() {
  state_->kernels.drop_unused();
  state_->raster_pipelines.drop_unused();
}

std::vector<std::string> Context::take_validation_messages() {
  if (state_->log == nullptr) return {};
  return std::exchange(state_->log->messages, {});
}

Timing Context::run(const std::function<void(Commands&)>& record) {
  ContextState& state = *state_;
  if (state.recording) throw std::invalid_argument("Context::run: called while it records");
  Submission& submission = *state.submission;
  Commands::State recording{.context = state, .commands = submission.begin(), .passes = {}};
  if (state.info.timestamps) submission.record_timestamp(recording.commands);
  Commands commands(recording);
  state.recording = true;
  try {
    record(commands);
  } catch (...) {
    state.recording = false;
    throw;
  }
  state.recording = false;
  if (state.info.timestamps) submission.record_timestamp(recording.commands);

  const auto start = std::chrono::steady_clock::now();
  submission.submit_and_wait(recording.commands);
  const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - start;
  check_zones(state);
  Timing timing{.seconds = waited.count(), .passes = {}};
  if (state.info.timestamps)
    timing = timing_of(state, submission.read_timestamps(), recording.passes);
  state.device_seconds += timing.seconds;
  return timing;
}

}  // namespace parity::gpu

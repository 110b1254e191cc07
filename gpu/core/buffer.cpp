#include "gpu/core/buffer.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>

#include "gpu/core/vulkan_state.h"

namespace parity::gpu {
namespace {

constexpr std::size_t zone_bytes = 256;
constexpr int poison = 0xCD;
constexpr std::uint32_t poison_word = 0xCDCDCDCD;

std::size_t page_bytes() { return static_cast<std::size_t>(sysconf(_SC_PAGESIZE)); }

std::size_t align(std::size_t value, std::size_t alignment) {
  return (value + alignment - 1) / alignment * alignment;
}

VkBufferCreateInfo buffer_info(std::size_t bytes) {
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = bytes;
  info.usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
               VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT |
               VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
  return info;
}

std::uint64_t address_of(const DeviceLink& link, VkBuffer buffer) {
  VkBufferDeviceAddressInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO;
  info.buffer = buffer;
  return vkGetBufferDeviceAddress(link.device, &info);
}

void copy_between(ContextState& context, VkBuffer from, std::size_t from_offset, VkBuffer to,
                  std::size_t to_offset, std::size_t bytes) {
  const VkCommandBuffer commands = context.submission->begin_transfer();
  full_barrier(commands);
  const VkBufferCopy region{from_offset, to_offset, bytes};
  vkCmdCopyBuffer(commands, from, to, 1, &region);
  context.submission->submit_and_wait(commands);
}

/// Bytes of the memory, from its start, through the staging buffer, a part at a time.
void upload(RawBuffer::State& state, const std::byte* source, std::size_t offset,
            std::size_t bytes) {
  const MemoryBuffer& staging = state.context.staging;
  const std::size_t most = staging.allocation.get().bytes;
  for (std::size_t done = 0; done < bytes; done += most) {
    const std::size_t part = std::min(most, bytes - done);
    std::memcpy(staging.allocation.get().mapped, source + done, part);
    copy_between(state.context, staging.buffer.get(), 0, state.memory.buffer.get(), offset + done,
                 part);
  }
}

void download(const RawBuffer::State& state, std::byte* target, std::size_t offset,
              std::size_t bytes) {
  const MemoryBuffer& staging = state.context.staging;
  const std::size_t most = staging.allocation.get().bytes;
  for (std::size_t done = 0; done < bytes; done += most) {
    const std::size_t part = std::min(most, bytes - done);
    copy_between(state.context, state.memory.buffer.get(), offset + done, staging.buffer.get(), 0,
                 part);
    std::memcpy(target + done, staging.allocation.get().mapped, part);
  }
}

void poison_all(RawBuffer::State& state) {
  if (state.mapped != nullptr) {
    std::memset(state.mapped, poison, state.total);
    return;
  }
  const VkCommandBuffer commands = state.context.submission->begin_transfer();
  full_barrier(commands);
  vkCmdFillBuffer(commands, state.memory.buffer.get(), 0, VK_WHOLE_SIZE, poison_word);
  state.context.submission->submit_and_wait(commands);
}

MemoryUse use_of(const ContextState& context) {
  return context.staged ? MemoryUse::fast : MemoryUse::shared;
}

void take_mapping(RawBuffer::State& state) {
  if (!state.context.staged) state.mapped = state.memory.allocation.get().mapped;
}

void allocate(RawBuffer::State& state) {
  state.total = align(std::max<std::size_t>(state.bytes, 4), 4);
  state.memory = make_buffer(state.context, state.total, use_of(state.context));
  state.buffer = state.memory.buffer.get();
  take_mapping(state);
}

/// The validation layer counts a vector of three as one of four, also within a struct. So much too
/// long it may take an element to be; its buffer is made that much longer, and an access a whole
/// element past its end is still outside.
std::size_t slack_bytes(std::size_t element_bytes) {
  return element_bytes == 16 ? 0 : std::min(element_bytes / 12 * 4, zone_bytes / 2);
}

/// A buffer of the elements alone lies inside a larger one. Since only its address is asked for,
/// the validation layer too knows what is outside.
void allocate_zoned(RawBuffer::State& state, std::size_t element_bytes) {
  ContextState& context = state.context;
  state.before = zone_bytes;
  state.total = align(2 * zone_bytes + state.bytes, zone_bytes);
  state.memory = make_buffer(context, state.total, use_of(context));
  take_mapping(state);
  const VkBufferCreateInfo info =
      buffer_info(std::max<std::size_t>(state.bytes, 1) + slack_bytes(element_bytes));
  state.inner = create<OwnedBuffer>(context.link(), vkCreateBuffer, info, "vkCreateBuffer");
  state.buffer = state.inner.get();
  const Allocation& part = state.memory.allocation.get();
  check(vkBindBufferMemory(context.link().device, state.buffer, part.memory,
                           part.offset + zone_bytes),
        "vkBindBufferMemory");
}

/// Whole pages of the host; the last byte of the elements is the last of the last page.
void import_pages(RawBuffer::State& state) {
  ContextState& context = state.context;
  state.total = align(std::max<std::size_t>(state.bytes, 1), page_bytes());
  state.before = state.total - state.bytes;
  state.start = state.before;
  state.pages = FencedPages(state.total);
  VkExternalMemoryBufferCreateInfo external{};
  external.sType = VK_STRUCTURE_TYPE_EXTERNAL_MEMORY_BUFFER_CREATE_INFO;
  external.handleTypes = VK_EXTERNAL_MEMORY_HANDLE_TYPE_HOST_ALLOCATION_BIT_EXT;
  VkBufferCreateInfo info = buffer_info(state.total);
  info.pNext = &external;
  state.memory.buffer = create<OwnedBuffer>(context.link(), vkCreateBuffer, info, "vkCreateBuffer");
  state.buffer = state.memory.buffer.get();
  VkMemoryRequirements needs{};
  vkGetBufferMemoryRequirements(context.link().device, state.buffer, &needs);
  const auto pointer_properties = reinterpret_cast<PFN_vkGetMemoryHostPointerPropertiesEXT>(
      vkGetDeviceProcAddr(context.link().device, "vkGetMemoryHostPointerPropertiesEXT"));
  VkMemoryHostPointerPropertiesEXT properties{};
  properties.sType = VK_STRUCTURE_TYPE_MEMORY_HOST_POINTER_PROPERTIES_EXT;
  check(pointer_properties(context.link().device,
                           VK_EXTERNAL_MEMORY_HANDLE_TYPE_HOST_ALLOCATION_BIT_EXT,
                           state.pages.data(), &properties),
        "vkGetMemoryHostPointerPropertiesEXT");
  const std::optional<std::uint32_t> type =
      context.memory->find_type(needs.memoryTypeBits & properties.memoryTypeBits, 0, 0);
  if (!type)
    throw Error(ErrorKind::missing_feature, "the device cannot use host memory for buffers");

  VkImportMemoryHostPointerInfoEXT import{};
  import.sType = VK_STRUCTURE_TYPE_IMPORT_MEMORY_HOST_POINTER_INFO_EXT;
  import.handleType = VK_EXTERNAL_MEMORY_HANDLE_TYPE_HOST_ALLOCATION_BIT_EXT;
  import.pHostPointer = state.pages.data();
  VkMemoryAllocateFlagsInfo flags{};
  flags.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO;
  flags.pNext = &import;
  flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
  VkMemoryAllocateInfo allocate_info{};
  allocate_info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  allocate_info.pNext = &flags;
  allocate_info.allocationSize = state.total;
  allocate_info.memoryTypeIndex = *type;
  state.imported =
      create<OwnedMemory>(context.link(), vkAllocateMemory, allocate_info, "vkAllocateMemory");
  check(vkBindBufferMemory(context.link().device, state.buffer, state.imported.get(), 0),
        "vkBindBufferMemory");
  state.mapped = state.pages.data();
}

bool is_poison(const std::byte* bytes, std::size_t count) {
  return std::all_of(bytes, bytes + count,
                     [](std::byte byte) { return byte == std::byte{poison}; });
}

}  // namespace

FencedPages::FencedPages(std::size_t bytes) : bytes_(bytes) {
  const std::size_t page = page_bytes();
  void* all = mmap(nullptr, bytes + 2 * page, PROT_NONE,
                   MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (all == MAP_FAILED)
    throw Error(ErrorKind::out_of_memory, "mmap: no pages for a fenced buffer");
  data_ = static_cast<std::byte*>(all) + page;
  if (mprotect(data_, bytes, PROT_READ | PROT_WRITE) == 0) return;
  munmap(all, bytes + 2 * page);
  throw Error(ErrorKind::out_of_memory, "mprotect: no pages for a fenced buffer");
}

FencedPages::~FencedPages() {
  if (data_ != nullptr) munmap(data_ - page_bytes(), bytes_ + 2 * page_bytes());
}

FencedPages::FencedPages(FencedPages&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), bytes_(other.bytes_) {}

FencedPages& FencedPages::operator=(FencedPages&& other) noexcept {
  std::swap(data_, other.data_);
  std::swap(bytes_, other.bytes_);
  return *this;
}

MemoryBuffer make_buffer(ContextState& context, std::size_t bytes, MemoryUse use) {
  MemoryBuffer made;
  const VkBufferCreateInfo info = buffer_info(bytes);
  made.buffer = create<OwnedBuffer>(context.link(), vkCreateBuffer, info, "vkCreateBuffer");
  VkMemoryRequirements needs{};
  vkGetBufferMemoryRequirements(context.link().device, made.buffer.get(), &needs);
  made.allocation = OwnedAllocation(*context.memory, context.memory->allocate(needs, use, true));
  const Allocation& part = made.allocation.get();
  check(vkBindBufferMemory(context.link().device, made.buffer.get(), part.memory, part.offset),
        "vkBindBufferMemory");
  return made;
}

RawBuffer::State::~State() {
  if (guard_entry) {
    context.guarded.erase(*guard_entry);
    // Whoever still holds the address shall see that it is stale.
    if (mapped != nullptr && !context.link().abandoned) std::memset(mapped, poison, total);
  }
  context.memory_bytes -= counted;
  if (context.link().abandoned) pages.leak();
}

RawBuffer::RawBuffer(Context& context, std::size_t bytes, std::size_t element_bytes) {
  ContextState& shared = context.state();
  if (bytes > shared.info.max_buffer_bytes)
    throw Error(ErrorKind::out_of_memory,
                "a buffer of " + std::to_string(bytes) + " bytes (elements of " +
                    std::to_string(element_bytes) + ") is larger than the device's " +
                    std::to_string(shared.info.max_buffer_bytes));
  state_ = std::make_unique<State>(shared);
  State& state = *state_;
  state.bytes = bytes;
  const Guard guard = shared.options.guard;
  if (guard == Guard::none) allocate(state);
  if (guard == Guard::zones) allocate_zoned(state, element_bytes);
  if (guard == Guard::fences) import_pages(state);
  state.address = address_of(shared.link(), state.buffer) + state.start;
  if (guard != Guard::none) {
    poison_all(state);
    state.guard_entry = shared.guarded.insert(shared.guarded.end(), &state);
  }
  shared.count_bytes(bytes);
  state.counted = bytes;
}

RawBuffer::RawBuffer() = default;
RawBuffer::~RawBuffer() = default;
RawBuffer::RawBuffer(RawBuffer&&) noexcept = default;
RawBuffer& RawBuffer::operator=(RawBuffer&&) noexcept = default;

void RawBuffer::write(const void* source, std::size_t byte_offset, std::size_t bytes) {
  if (bytes == 0) return;
  if (state_->mapped != nullptr)
    std::memcpy(state_->mapped + state_->before + byte_offset, source, bytes);
  else
    upload(*state_, static_cast<const std::byte*>(source), state_->before + byte_offset, bytes);
}

void RawBuffer::read(void* target, std::size_t byte_offset, std::size_t bytes) const {
  if (bytes == 0) return;
  if (state_->mapped != nullptr)
    std::memcpy(target, state_->mapped + state_->before + byte_offset, bytes);
  else
    download(*state_, static_cast<std::byte*>(target), state_->before + byte_offset, bytes);
}

std::size_t RawBuffer::bytes() const { return state_ == nullptr ? 0 : state_->bytes; }
std::uint64_t RawBuffer::address() const { return state_ == nullptr ? 0 : state_->address; }

void check_zones(ContextState& context) {
  std::vector<std::byte> copy;
  for (const RawBuffer::State* state : context.guarded) {
    const std::size_t end = state->before + state->bytes;
    const std::byte* bytes = state->mapped;
    if (bytes == nullptr) {
      copy.resize(state->total);
      download(*state, copy.data(), 0, state->before);
      download(*state, copy.data() + end, end, state->total - end);
      bytes = copy.data();
    }
    const bool broken_before = !is_poison(bytes, state->before);
    if (broken_before || !is_poison(bytes + end, state->total - end))
      throw Error(ErrorKind::broken_guard,
                  "something wrote " +
                      std::string(broken_before ? "before the start" : "past the end") +
                      " of a buffer of " + std::to_string(state->bytes) + " bytes");
  }
}

}  // namespace parity::gpu

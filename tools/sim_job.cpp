#include "tools/sim_job.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "geometry/atomic_file.h"
#include "geometry/image_io.h"
#include "geometry/input_error.h"
#include "geometry/output_error.h"
#include "sim/scene_io.h"
#include "tools/progress.h"
#include "tools/sim_checkpoint.h"
#include "tools/sim_export.h"
#include "tools/sim_picture.h"
#include "tools/sim_run.h"
#include "tools/sim_video.h"

namespace parity::tools {
namespace {

using nlohmann::json;

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// null where it has no meaning.
json number(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

json measures_json(const SimMeasures& m, std::uint64_t steps) {
  return {{"time_s", m.time},
          {"steps", steps},
          {"mass_kg", number(m.mass)},
          {"momentum_kg_m_per_s", {m.momentum.x, m.momentum.y, m.momentum.z}},
          {"kinetic_energy_j", number(m.kinetic_energy)},
          {"potential_energy_j", number(m.potential_energy)},
          {"max_speed_m_per_s", number(m.max_speed)},
          {"divergence_per_s", number(m.divergence)},
          {"density_error", number(m.density_error)},
          {"max_density_error", number(m.max_density_error)}};
}

Simulation start(const SimJob& job, const SimScene& scene, gpu::Context* context) {
  try {
    return start_simulation(scene, context);
  } catch (const std::invalid_argument& error) {
    throw InputError(job.input, error.what());
  }
}

class Runner {
 public:
  Runner(const SimJob& job, const SimScene& scene, gpu::Context* context)
      : job_(job),
        scene_(scene),
        physics_(physics_text(scene)),
        simulation_(start(job, scene, context)),
        drawer_(context) {
    make_folder();
    if (job.resume) restore();
  }

  int run() {
    begin_ = last_checkpoint_ = seconds_now();
    const int last = frame_count(scene_);
    const std::size_t known = history_.size();
    Progress progress{"simulating", 1000, job_.quiet};
    for (int frame = int(known); frame <= last; ++frame) {
      if (!advance(frame / scene_.frames_per_second, last, progress)) return stop(130, false);
      write_frame(frame);
      history_.push_back(measures_json(simulation_.measures(), steps_));
      if (seconds_now() - last_checkpoint_ >= job_.checkpoint_seconds) checkpoint();
      if (is_broken()) return stop(1, false);
    }
    progress.clear();
    return stop(0, true);
  }

 private:
  std::filesystem::path file(const std::string& name) const {
    return std::filesystem::path(job_.folder) / name;
  }

  void make_folder() const {
    std::error_code error;
    std::filesystem::create_directories(job_.folder, error);
    if (error || !std::filesystem::is_directory(job_.folder))
      throw OutputError(job_.folder, error ? error.message() : "is no folder");
  }

  void restore() {
    const std::string path = file("checkpoint.bin").string();
    const Checkpoint c = load_checkpoint(path, physics_, job_.backend);
    try {
      simulation_.restore(c.state);
    } catch (const std::runtime_error& error) {
      throw InputError(path, error.what());
    } catch (const std::invalid_argument& error) {
      throw InputError(path, error.what());
    }
    steps_ = c.steps;
    seconds_before_ = c.seconds;
    history_ = json::parse(c.history);
  }

  void checkpoint() {
    save_checkpoint(file("checkpoint.bin"), {.physics = physics_,
                                             .backend = job_.backend,
                                             .steps = steps_,
                                             .frames = std::uint32_t(history_.size()),
                                             .seconds = seconds(),
                                             .history = history_.dump(),
                                             .state = simulation_.save()});
    last_checkpoint_ = seconds_now();
  }

  double seconds() const { return seconds_before_ + seconds_now() - begin_; }

  /// False: interrupted, between two steps.
  bool advance(double until, int last, Progress& progress) {
    const double end = std::max(last, 1) / scene_.frames_per_second;
    while (!simulation_.has_reached(until)) {
      if (job_.is_interrupted && job_.is_interrupted()) return false;
      const double start = seconds_now();
      const std::uint64_t steps = simulation_.step(until);
      step_seconds_ += seconds_now() - start;
      steps_ += steps;
      if (steps == 0 && !simulation_.has_reached(until))
        throw std::runtime_error("the simulation does not move on from " +
                                 std::to_string(simulation_.time()) + " s");
      progress.set(std::size_t(1000 * std::min(simulation_.time() / end, 1.0)));
    }
    return !(job_.is_interrupted && job_.is_interrupted());
  }

  void write_frame(int frame) {
    if (job_.frames && (frame < job_.frames->x || frame > job_.frames->y)) return;
    const double start = seconds_now();
    const SimContent content = simulation_.content();
    const std::string number = fmt::format("{:04}", frame);
    if (scene_.output.png)
      save_png(file("frame_" + number + ".png"), display_image(drawer_.draw(scene_, content)));
    if (scene_.output.ply && !content.positions.empty())
      write_file_atomically(file("particles_" + number + ".ply"), encode_particles_ply(content));
    if (scene_.output.vtk && !content.positions.empty())
      write_file_atomically(file("particles_" + number + ".vtp"), encode_vtp(content));
    if (scene_.output.vtk && content.cells.x > 0)
      write_file_atomically(file("fields_" + number + ".vti"), encode_vti(content));
    draw_seconds_ += seconds_now() - start;
  }

  /// A number of the last frame that is not finite.
  bool is_broken() const {
    const json& last = history_.back();
    return last["kinetic_energy_j"].is_null() || last["mass_kg"].is_null();
  }

  json metrics(bool finished) const {
    json result{{"schema", "parity.sim"},
                {"version", 1},
                {"scene", job_.input},
                {"title", scene_.title},
                {"method", name_of(scene_.method)},
                {"backend", job_.backend},
                {"device", simulation_.device},
                {"dimensions", scene_.dimensions},
                {"spacing_m", scene_.spacing},
                {"particles", simulation_.particles},
                {"cells", simulation_.cells},
                {"duration_s", scene_.duration},
                {"finished", finished},
                {"steps", steps_},
                {"seconds", seconds()},
                {"step_seconds", step_seconds_},
                {"draw_seconds", draw_seconds_},
                {"frames", history_}};
    if (simulation_.refused) result["refused_steps"] = simulation_.refused();
    return result;
  }

  int stop(int code, bool finished) {
    checkpoint();
    const std::string text = metrics(finished).dump(2) + "\n";
    write_file_atomically(file("metrics.json"), text);
    if (job_.json) std::fwrite(text.data(), 1, text.size(), stdout);
    if (code == 1)
      std::fprintf(stderr, "parity: the simulation broke down at %g s: its energy is not finite\n",
                   simulation_.time());
    if (code == 130 && !job_.quiet)
      std::fprintf(stderr, "parity: interrupted at %g s; --resume goes on from there\n",
                   simulation_.time());
    if (code == 0 && job_.video && scene_.output.png)
      make_video(job_.folder, scene_.frames_per_second, job_.quiet);
    if (job_.verbose)
      std::fprintf(stderr,
                   "%s: %zu frames, %llu steps, %.1f s (%.1f stepping, %.1f drawing) on %s\n",
                   job_.folder.c_str(), history_.size(), static_cast<unsigned long long>(steps_),
                   seconds(), step_seconds_, draw_seconds_, simulation_.device.c_str());
    return code;
  }

  const SimJob& job_;
  const SimScene& scene_;
  std::string physics_;
  Simulation simulation_;
  FrameDrawer drawer_;
  json history_ = json::array();
  std::uint64_t steps_ = 0;
  double begin_ = 0, last_checkpoint_ = 0, seconds_before_ = 0;
  double step_seconds_ = 0, draw_seconds_ = 0;
};

}  // namespace

int run_sim_job(const SimJob& job, const SimScene& scene, gpu::Context* context) {
  return Runner(job, scene, context).run();
}

}  // namespace parity::tools

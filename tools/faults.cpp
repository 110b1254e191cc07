#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <span>

#include "geometry/input_error.h"
#include "geometry/output_error.h"
#include "tests/stage.h"
#include "tools/fault_plan.h"
#include "tools/progress.h"
#include "tools/verb.h"

namespace parity::tools {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> patterns;
  fs::path source = ".";
  fs::path folder;  ///< default: SOURCE/build-faults
  int jobs = 0;     ///< 0: as many as the build tool likes
  bool json = false;
  bool list = false;
};

/// What came of a planted fault.
struct Outcome {
  Fault fault;
  bool caught = false;
  std::string detail;  ///< the tests that went red, or why it was not caught
};

std::string quoted(const std::string& word) {
  std::string text = "'";
  for (char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string read_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path.string(), "cannot be read");
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_text(const fs::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  if (!(file << text) || !file.flush()) throw OutputError(path.string(), "cannot be written");
}

/// A copy of the source that is built again and again, with one fault at a time.
class Nursery {
 public:
  Nursery(const fs::path& source, const fs::path& folder, int jobs)
      : source_(folder / "source"), log_(folder / "log.txt"), jobs_(jobs) {
    fs::create_directories(source_);
    remove_strangers(source);
    const auto options = fs::copy_options::recursive | fs::copy_options::update_existing;
    for (const char* part : copied_) {
      if (fs::exists(source / part)) fs::copy(source / part, source_ / part, options);
    }
  }

  bool configure() {
    return run("cmake -S " + quoted(source_.string()) + " -B " + quoted(build()) +
               " -G Ninja -DCMAKE_BUILD_TYPE=Release") == 0;
  }

  /// Builds what the tests of these faults run in.
  bool compile(std::span<const Fault> faults) {
    std::string targets;
    if (std::ranges::any_of(faults, [](const Fault& f) { return !f.tests.empty(); }))
      targets += " parity_tests";
    if (std::ranges::any_of(faults, [](const Fault& f) { return !f.checks.empty(); }))
      targets += " parity";
    const std::string jobs = jobs_ > 0 ? " -j " + std::to_string(jobs_) : "";
    return run("cmake --build " + quoted(build()) + jobs + " --target" + targets) == 0;
  }

  /// 0 if all tests of the fault pass.
  int test(const Fault& fault) {
    if (!fault.tests.empty())
      return run("timeout 300 " + quoted(build() + "/bin/parity_tests") +
                 " --gtest_filter=" + quoted(fault.tests));
    return run("timeout 300 " + quoted(build() + "/bin/parity") + " check --timeout 60 -o " +
               quoted((log_.parent_path() / "failures").string()) + " " + fault.checks);
  }

  std::string output() const { return read_text(log_); }
  fs::path file(const std::string& name) const { return source_ / name; }

 private:
  std::string build() const { return (source_ / "build").string(); }

  /// The compiler's cache knows these files from the build beside them, if paths are relative to
  /// it.
  int run(const std::string& command) {
    const std::string environment =
        "CCACHE_BASEDIR=" +
        quoted(fs::absolute(source_).parent_path().parent_path().parent_path().string()) +
        " CCACHE_NOHASHDIR=1 ";
    const int status =
        std::system((environment + command + " > " + quoted(log_.string()) + " 2>&1").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  }

  /// Files of an earlier copy that the source has no longer.
  void remove_strangers(const fs::path& source) {
    for (const char* part : copied_) {
      if (!fs::is_directory(source_ / part)) continue;
      std::vector<fs::path> strangers;
      for (const auto& entry : fs::recursive_directory_iterator(source_ / part))
        if (!fs::exists(source / entry.path().lexically_relative(source_)))
          strangers.push_back(entry.path());
      for (const fs::path& path : strangers) fs::remove_all(path);
    }
  }

  static constexpr const char* copied_[] = {"CMakeLists.txt",
                                            "CMakePresets.json",
                                            "geometry",
                                            "sim",
                                            "cpu_reference",
                                            "gpu",
                                            "shaders",
                                            "tests",
                                            "tools",
                                            "assets",
                                            "docs"};
  fs::path source_, log_;
  int jobs_;
};

std::string joined(const std::vector<std::string>& names, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i)
    text += (i > 0 ? ", " : "") + names[i];
  if (names.size() > most) text += " and " + std::to_string(names.size() - most) + " more";
  return text;
}

Outcome try_fault(Nursery& nursery, const Fault& fault) {
  Outcome outcome{.fault = fault, .detail = {}};
  const std::string original = read_text(nursery.file(fault.file));
  write_text(nursery.file(fault.file), planted(fault, original));
  if (!nursery.compile({&fault, 1})) {
    outcome.detail = "does not build";
  } else {
    const int status = nursery.test(fault);
    const std::vector<std::string> red = failed_tests(nursery.output());
    outcome.caught = status != 0;
    outcome.detail = red.empty()
                         ? (status == 0 ? "all tests stayed green"
                                        : "the test program ended with " + std::to_string(status))
                         : joined(red, 3);
  }
  write_text(nursery.file(fault.file), original);
  return outcome;
}

void require_green(Nursery& nursery, const std::vector<Fault>& faults) {
  if (!nursery.configure() || !nursery.compile(faults))
    throw std::runtime_error("faults: the source does not build without a fault:\n" +
                             nursery.output());
  std::set<std::string> done;
  for (const Fault& fault : faults)
    if (done.insert(fault.tests + fault.checks).second && nursery.test(fault) != 0)
      throw std::runtime_error("faults: red without a fault: " +
                               joined(failed_tests(nursery.output()), 5));
}

void print(const std::vector<Outcome>& outcomes) {
  std::size_t width = 0, caught = 0;
  for (const Outcome& outcome : outcomes) width = std::max(width, outcome.fault.name.size());
  for (const Outcome& outcome : outcomes) {
    caught += outcome.caught ? 1 : 0;
    std::printf("%-8s  %-*s  %s\n          %s\n", outcome.caught ? "caught" : "MISSED",
                static_cast<int>(width), outcome.fault.name.c_str(), outcome.fault.file.c_str(),
                outcome.detail.c_str());
  }
  std::printf("%zu of %zu seeded faults turn a test red\n", caught, outcomes.size());
}

nlohmann::json to_json(const std::vector<Outcome>& outcomes) {
  nlohmann::json array = nlohmann::json::array();
  for (const Outcome& outcome : outcomes)
    array.push_back({{"name", outcome.fault.name},
                     {"file", outcome.fault.file},
                     {"caught", outcome.caught},
                     {"detail", outcome.detail}});
  return {{"version", 1}, {"faults", array}};
}

int run_faults(Options& options) {
  std::vector<Fault> faults = read_faults(options.source / "tests" / "faults" / "faults.json");
  std::erase_if(faults,
                [&](const Fault& fault) { return !name_matches(fault.name, options.patterns); });
  if (faults.empty()) throw std::invalid_argument("faults: no fault of that name");
  if (options.list) {
    for (const Fault& fault : faults)
      std::printf("%s  %s\n", fault.name.c_str(), fault.file.c_str());
    return 0;
  }
  if (options.folder.empty()) options.folder = options.source / "build-faults";
  Nursery nursery(options.source, fs::absolute(options.folder), options.jobs);
  std::fprintf(stderr, "building the copy of the source in %s\n", options.folder.c_str());
  require_green(nursery, faults);
  std::vector<Outcome> outcomes;
  Progress progress("planting faults", faults.size());
  for (const Fault& fault : faults) {
    outcomes.push_back(try_fault(nursery, fault));
    progress.advance();
  }
  progress.clear();
  if (options.json)
    std::printf("%s\n", to_json(outcomes).dump(2).c_str());
  else
    print(outcomes);
  return std::ranges::all_of(outcomes, &Outcome::caught) ? 0 : 1;
}

}  // namespace

void add_faults_verb(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "faults", "Plant known mistakes into a copy of the source; each must turn a test red");
  const auto options = std::make_shared<Options>();
  verb->add_option("GLOB", options->patterns, "Names of faults, with * and ?");
  verb->add_option("--source", options->source, "Folder of the source")
      ->check(CLI::ExistingDirectory);
  verb->add_option("-o,--output", options->folder,
                   "Folder for the copy; kept to build faster again");
  verb->add_option("-j,--jobs", options->jobs, "Compilers at a time");
  verb->add_flag("--json", options->json, "Machine-readable output");
  verb->add_flag("--list", options->list, "Print the faults and plant none");
  verb->footer(
      "Exits with 1 if a fault is missed.\nExamples:\n  parity faults\n  parity faults "
      "'*top-left*'");
  verb->callback([options, &exit_code] { exit_code = run_faults(*options); });
}

}  // namespace parity::tools

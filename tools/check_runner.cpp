#include "tools/check_runner.h"

#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <memory>
#include <system_error>

#include "geometry/output_error.h"
#include "gpu/core/context.h"
#include "tools/replay.h"

namespace parity::tools {
namespace {

using nlohmann::json;

// ---- The worker: runs checks, says what happens in lines of JSON ----

void send(int pipe, const json& message) {
  const std::string line = message.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
  for (std::size_t sent = 0; sent < line.size();) {
    const ssize_t written = write(pipe, line.data() + sent, line.size() - sent);
    if (written < 0 && errno != EINTR) _exit(1);
    if (written > 0) sent += static_cast<std::size_t>(written);
  }
}

json to_json(const MethodTrial& method) {
  json entry = {{"method", method.method}, {"seconds", method.seconds}};
  const auto put = [&](const char* key, const std::optional<double>& value) {
    if (value) entry[key] = std::isfinite(*value) ? json(*value) : json(short_number(*value));
  };
  put("distance", method.distance);
  put("error", method.error);
  put("growth", method.growth);
  if (!method.judge.empty()) entry["judge"] = method.judge;
  if (!method.skipped.empty()) entry["skipped"] = method.skipped;
  return entry;
}

const char* outcome_name(CheckResult::Outcome outcome) {
  switch (outcome) {
    case CheckResult::Outcome::passed:
      return "passed";
    case CheckResult::Outcome::failed:
      return "failed";
    case CheckResult::Outcome::skipped:
      return "skipped";
  }
  return "";
}

json run_one(const Check& check, gpu::Context* context, const CheckRunOptions& options) {
  std::optional<std::span<const double>> problem;
  if (options.problem) problem = std::span<const double>(*options.problem);
  const CheckResult result = run_check(check, context, problem);
  json methods = json::array();
  for (const MethodTrial& method : result.trial.methods) methods.push_back(to_json(method));
  json message = {{"outcome", outcome_name(result.outcome)},
                  {"message", result.message},
                  {"seconds", result.seconds},
                  {"methods", methods}};
  if (result.outcome != CheckResult::Outcome::failed) return message;
  try {
    message["replay"] = write_replay(options.folder, check, result,
                                     context == nullptr ? "none" : context->info().name)
                            .string();
  } catch (const OutputError& error) {
    message["message"] = result.message + "; its files were not written: " + error.what();
  }
  return message;
}

void work(int pipe, const std::vector<Check>& checks, std::size_t first,
          const CheckRunOptions& options) {
  std::optional<gpu::Context> context;
  if (!options.host_only)
    context.emplace(gpu::ContextOptions{.device = options.device,
                                        .validation = options.validation,
                                        .guard = gpu::Guard::zones,
                                        .timeout_seconds = options.timeout_seconds});
  const std::string device =
      context ? context->info().name + ", " + context->info().driver : std::string("no device");
  send(pipe, {{"device", device}});
  for (std::size_t i = first; i < checks.size(); ++i)
    send(pipe, run_one(checks[i], context ? &*context : nullptr, options));
}

/// Never returns; leaves without running the parent's destructors.
[[noreturn]] void worker_main(int pipe, const std::vector<Check>& checks, std::size_t first,
                              const CheckRunOptions& options) {
  try {
    work(pipe, checks, first, options);
  } catch (const gpu::Error& error) {
    send(pipe, {{"device_error", error.what()}, {"kind", static_cast<int>(error.kind())}});
    _exit(1);
  } catch (const std::exception& error) {
    send(pipe, {{"fatal", error.what()}});
    _exit(1);
  }
  _exit(0);
}

// ---- The parent: listens with a clock in hand ----

class Worker {
 public:
  Worker(const std::vector<Check>& checks, std::size_t first, const CheckRunOptions& options) {
    int ends[2];
    if (pipe(ends) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
    std::fflush(nullptr);
    process_ = fork();
    if (process_ < 0) throw std::system_error(errno, std::generic_category(), "fork");
    if (process_ == 0) {
      close(ends[0]);
      worker_main(ends[1], checks, first, options);
    }
    close(ends[1]);
    pipe_ = ends[0];
  }
  ~Worker() {
    end();
    close(pipe_);
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// The next line; none if the worker is gone or silent for too long: then why() says so.
  std::optional<json> next(double timeout_seconds) {
    const double deadline = detail::wall_seconds() + timeout_seconds;
    for (;;) {
      const std::size_t newline = text_.find('\n');
      if (newline != std::string::npos) {
        const json line = json::parse(text_.substr(0, newline));
        text_.erase(0, newline + 1);
        return line;
      }
      const double left = deadline - detail::wall_seconds();
      pollfd wait{pipe_, POLLIN, 0};
      const int ready = left > 0 ? poll(&wait, 1, static_cast<int>(std::ceil(left * 1000))) : 0;
      if (ready < 0 && errno == EINTR) continue;
      if (ready == 0) {
        why_ = "timed out after " + short_number(timeout_seconds) + " s";
        return std::nullopt;
      }
      if (!fill()) return std::nullopt;
    }
  }

  const std::string& why() const { return why_; }

 private:
  bool fill() {
    char bytes[4096];
    const ssize_t count = read(pipe_, bytes, sizeof bytes);
    if (count > 0) text_.append(bytes, static_cast<std::size_t>(count));
    if (count > 0 || (count < 0 && errno == EINTR)) return true;
    int status = 0;
    waitpid(process_, &status, 0);
    process_ = -1;
    why_ = WIFSIGNALED(status) ? std::string("crashed: ") + strsignal(WTERMSIG(status))
                               : "ended with exit code " + std::to_string(WEXITSTATUS(status));
    return false;
  }

  void end() {
    if (process_ < 0) return;
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
    process_ = -1;
  }

  pid_t process_ = -1;
  int pipe_ = -1;
  std::string text_;
  std::string why_;
};

std::string quoted(const std::string& word) {
  if (word.find_first_of(" '\"$*?\\") == std::string::npos) return word;
  std::string text = "'";
  for (char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string reproduce_command(const Check& check, const std::string& replay) {
  std::string command = "parity check " + quoted(check.stage->name);
  if (!replay.empty()) return command + " --replay " + quoted(replay);
  for (const auto& [axis, value] : check.named.setting.values())
    command += " --setting " + axis + "=" + short_number(value);
  if (check.named.setting.seed != 1)
    command += " --seed " + std::to_string(check.named.setting.seed);
  return command;
}

CheckReport make_report(const Check& check, const json& line) {
  CheckReport report{.name = check.name(),
                     .outcome = line.at("outcome").get<std::string>(),
                     .message = line.at("message").get<std::string>(),
                     .reproduce = {},
                     .seconds = line.at("seconds").get<double>(),
                     .methods = line.at("methods")};
  if (report.outcome == "failed")
    report.reproduce = reproduce_command(check, line.value("replay", std::string()));
  return report;
}

CheckReport make_failure(const Check& check, const std::string& why, double seconds) {
  return {.name = check.name(),
          .outcome = "failed",
          .message = why,
          .reproduce = reproduce_command(check, ""),
          .seconds = seconds};
}

/// Runs from `first` until the worker ends; returns the index to go on with.
std::size_t run_from(std::size_t first, const std::vector<Check>& checks,
                     const CheckRunOptions& options, std::string& device,
                     const std::function<void(const CheckReport&)>& report) {
  Worker worker(checks, first, options);
  // The device gets its own time-out; it must have none of the first check's.
  const std::optional<json> started = worker.next(options.timeout_seconds);
  if (!started) throw gpu::Error(gpu::ErrorKind::timed_out, "starting the device: " + worker.why());
  if (started->contains("device_error"))
    throw gpu::Error(static_cast<gpu::ErrorKind>(started->at("kind").get<int>()),
                     started->at("device_error").get<std::string>());
  device = started->value("device", std::string());
  for (std::size_t i = first; i < checks.size(); ++i) {
    const double start = detail::wall_seconds();
    const std::optional<json> line = worker.next(options.timeout_seconds);
    const double seconds = detail::wall_seconds() - start;
    std::string why = worker.why();
    if (line && line->contains("device_error")) why = line->at("device_error").get<std::string>();
    if (line && line->contains("fatal")) why = line->at("fatal").get<std::string>();
    if (!line || !line->contains("outcome")) {
      report(make_failure(checks[i], why, seconds));
      return i + 1;
    }
    report(make_report(checks[i], *line));
  }
  return checks.size();
}

}  // namespace

std::string run_checks(const std::vector<Check>& checks, const CheckRunOptions& options,
                       const std::function<void(const CheckReport&)>& report) {
  std::string device;
  for (std::size_t next = 0; next < checks.size();)
    next = run_from(next, checks, options, device, report);
  return device;
}

}  // namespace parity::tools

#include "tools/replay.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "geometry/atomic_file.h"
#include "geometry/input_error.h"

namespace parity::tools {
namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "files are little-endian");

constexpr std::size_t max_inline_numbers = 4096;
constexpr std::size_t max_file_bytes = std::size_t{1} << 30;
constexpr int max_json_depth = 16;

/// Numbers on their way into the JSON or, where that cannot hold them, into the file beside it.
class NumberWriter {
 public:
  explicit NumberWriter(std::string binary_name) : binary_name_(std::move(binary_name)) {}

  json put(const std::vector<double>& numbers) {
    const bool finite = std::ranges::all_of(numbers, [](double n) { return std::isfinite(n); });
    if (finite && numbers.size() <= max_inline_numbers) return numbers;
    json place = {{"file", binary_name_},
                  {"type", "float64 little-endian"},
                  {"byte_offset", binary_.size() * sizeof(double)},
                  {"count", numbers.size()}};
    binary_.insert(binary_.end(), numbers.begin(), numbers.end());
    return place;
  }

  void write(const std::filesystem::path& folder) const {
    if (!binary_.empty())
      write_file_atomically(folder / binary_name_, std::as_bytes(std::span(binary_)));
  }

 private:
  std::string binary_name_;
  std::vector<double> binary_;
};

std::string file_stem(const std::string& check_name) {
  std::string stem = check_name;
  std::ranges::replace_if(
      stem,
      [](char c) {
        return !std::isalnum(static_cast<unsigned char>(c)) && !std::strchr("_=.-", c);
      },
      '-');
  return stem;
}

std::vector<double> difference(const std::vector<double>& got, const std::vector<double>& want) {
  std::vector<double> result(std::min(got.size(), want.size()));
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = got[i] - want[i];
  return result;
}

json answers_to_json(const Stage& stage, const Trial& trial, NumberWriter& writer) {
  json answers = json::array();
  for (std::size_t i = 0; i < trial.methods.size(); ++i) {
    const MethodTrial& method = trial.methods[i];
    json entry = {{"method", method.method}, {"skipped", method.skipped}};
    if (trial.attempts[i]) {
      const std::vector<double> got = stage.answer_numbers(*trial.attempts[i]);
      entry["answer"] = writer.put(got);
      if (method.distance) {
        const Attempt& judge = *trial.attempts[*stage.methods[i].judge];
        entry["distance"] = short_number(*method.distance);
        entry["judge"] = method.judge;
        entry["difference"] = writer.put(difference(got, stage.answer_numbers(judge)));
      }
    }
    answers.push_back(entry);
  }
  return answers;
}

json parse(const std::filesystem::path& file) {
  const std::vector<std::byte> bytes = read_file(file, max_file_bytes);
  const auto* text = reinterpret_cast<const char*>(bytes.data());
  const auto shallow = [](int depth, json::parse_event_t, json&) {
    if (depth > max_json_depth) throw std::invalid_argument("nested too deeply");
    return true;
  };
  return json::parse(text, text + bytes.size(), shallow);
}

std::vector<double> get_numbers(const json& value, const std::filesystem::path& folder) {
  if (value.is_array()) return value.get<std::vector<double>>();
  const std::filesystem::path name = value.at("file").get<std::string>();
  if (name != name.filename()) throw std::invalid_argument("its file of numbers is not beside it");
  const std::vector<std::byte> bytes = read_file(folder / name, max_file_bytes);
  const auto offset = value.at("byte_offset").get<std::size_t>();
  const auto count = value.at("count").get<std::size_t>();
  if (offset > bytes.size() || count > (bytes.size() - offset) / sizeof(double))
    throw std::invalid_argument("numbers " + std::to_string(offset) + " + 8 x " +
                                std::to_string(count) + " of a file of " +
                                std::to_string(bytes.size()) + " bytes");
  std::vector<double> numbers(count);
  std::memcpy(numbers.data(), bytes.data() + offset, count * sizeof(double));
  return numbers;
}

Replay from_json(const json& file, const std::filesystem::path& folder) {
  Replay replay;
  replay.stage = file.at("stage").get<std::string>();
  const auto stage = std::ranges::find(all_stages(), replay.stage, &Stage::name);
  if (stage == all_stages().end()) throw std::invalid_argument("no stage " + replay.stage);
  replay.setting = Setting(stage->axes);
  replay.setting.seed = file.at("seed").get<std::uint64_t>();
  for (const auto& [axis, value] : file.at("setting").items())
    replay.setting.set(axis, value.get<double>());
  replay.problem = get_numbers(file.at("problem"), folder);
  return replay;
}

}  // namespace

std::filesystem::path write_replay(const std::filesystem::path& folder, const Check& check,
                                   const CheckResult& result, const std::string& device) {
  std::error_code ignored;  // writing says what is wrong
  std::filesystem::create_directories(folder, ignored);
  const std::string stem = file_stem(check.name());
  NumberWriter writer(stem + ".bin");
  json setting = json::object();
  for (const auto& [axis, value] : check.named.setting.values()) setting[axis] = value;
  json file = {{"version", 1},
               {"stage", check.stage->name},
               {"check", check.name()},
               {"setting", setting},
               {"seed", check.named.setting.seed},
               {"device", device},
               {"message", result.message},
               {"tolerance", short_number(result.trial.tolerance)},
               {"why", check.stage->why}};
  file["problem"] = json::array();
  if (result.problem.has_value())
    file["problem"] = writer.put(check.stage->problem_numbers(result.problem));
  file["answers"] = answers_to_json(*check.stage, result.trial, writer);
  writer.write(folder);
  const std::filesystem::path path = folder / (stem + ".json");
  write_file_atomically(path, file.dump(1) + "\n");
  return path;
}

Replay read_replay(const std::filesystem::path& file) {
  try {
    return from_json(parse(file), file.parent_path());
  } catch (const json::exception& error) {
    throw InputError(file.string(), std::string("no replay file: ") + error.what());
  } catch (const std::invalid_argument& error) {
    throw InputError(file.string(), error.what());
  }
}

}  // namespace parity::tools

#include "tests/chart.h"

#include <algorithm>
#include <stdexcept>

namespace parity {
namespace {

template <typename Entry>
std::vector<Entry>& registry() {
  static std::vector<Entry> entries;
  return entries;
}

/// Keeps the entries sorted by name.
template <typename Entry>
Registration add(Entry entry, bool has_function) {
  std::vector<Entry>& entries = registry<Entry>();
  if (entry.name.empty() || !has_function)
    throw std::logic_error("chart or map '" + entry.name + "': needs a name and a function");
  const auto place = std::ranges::lower_bound(entries, entry.name, {}, &Entry::name);
  if (place != entries.end() && place->name == entry.name)
    throw std::logic_error("chart or map '" + entry.name + "' is registered twice");
  entries.insert(place, std::move(entry));
  return {};
}

}  // namespace

Registration register_chart(Chart chart) {
  const bool has_function = static_cast<bool>(chart.produce);
  return add(std::move(chart), has_function);
}

Registration register_map(Map map) {
  const bool has_function = static_cast<bool>(map.value);
  return add(std::move(map), has_function);
}

std::span<const Chart> all_charts() { return registry<Chart>(); }

std::span<const Map> all_maps() { return registry<Map>(); }

}  // namespace parity

#include "check/symbols.hpp"

#include <algorithm>

namespace zwang::lang {

namespace {

template <typename Items, typename Name>
std::optional<int> index_of(const Items& items, const std::string& name, const Name& name_of) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (name_of(items[i]) == name) return static_cast<int>(i);
  }
  return std::nullopt;
}

template <typename Items, typename Name>
std::vector<std::string> names_of(const Items& items, const Name& name_of) {
  std::vector<std::string> names;
  for (const auto& item : items) names.push_back(name_of(item));
  return names;
}

const auto signal_name = [](const SignalSymbol& s) { return s.signal.name; };
const auto output_name = [](const OutputSymbol& s) { return s.output.name; };
const auto feature_name = [](const FeatureSymbol& s) { return s.feature.name; };
const auto region_name = [](const RegionSymbol& s) { return s.region.name; };

}  // namespace

bool Symbols::stands_in_world(int frame) const {
  while (frame > 0) {
    const FrameSymbol& symbol = frames[static_cast<std::size_t>(frame)];
    const FrameDeclaration& declaration = symbol.declaration;
    const bool is_carried = symbol.is_bad || symbol.body >= 0 || declaration.parent == FrameParent::body ||
                            declaration.parent == FrameParent::signal;
    if (is_carried) return false;
    frame = declaration.parent == FrameParent::frame ? declaration.parent_index : 0;
  }
  return true;
}

int Symbols::signal_of(int frame) const {
  while (frame > 0) {
    const FrameDeclaration& declaration = frames[static_cast<std::size_t>(frame)].declaration;
    if (declaration.parent == FrameParent::signal) return declaration.parent_index;
    frame = declaration.parent == FrameParent::frame ? declaration.parent_index : 0;
  }
  return -1;
}

std::optional<int> Symbols::find_signal(const std::string& name) const {
  return index_of(signals, name, signal_name);
}

std::optional<int> Symbols::find_output(const std::string& name) const {
  return index_of(outputs, name, output_name);
}

std::optional<int> Symbols::find_feature(const std::string& name) const {
  return index_of(features, name, feature_name);
}

std::optional<int> Symbols::find_region(const std::string& name) const {
  return index_of(regions, name, region_name);
}

std::vector<std::string> Symbols::signal_names() const {
  return names_of(signals, signal_name);
}

std::vector<std::string> Symbols::output_names() const {
  return names_of(outputs, output_name);
}

std::vector<std::string> Symbols::feature_names() const {
  return names_of(features, feature_name);
}

std::vector<std::string> Symbols::region_names() const {
  return names_of(regions, region_name);
}

ParameterSymbol* Symbols::find_parameter(const std::string& name) {
  for (ParameterSymbol& symbol : parameters) {
    if (symbol.parameter.name == name) return &symbol;
  }
  return nullptr;
}

std::optional<int> Symbols::find_frame(const std::string& name) const {
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].declaration.name == name) return static_cast<int>(i);
  }
  return std::nullopt;
}

std::optional<int> Symbols::find_task(const std::string& name) const {
  const auto it = std::find(tasks.begin(), tasks.end(), name);
  if (it == tasks.end()) return std::nullopt;
  return static_cast<int>(it - tasks.begin());
}

std::vector<std::string> Symbols::parameter_names() const {
  std::vector<std::string> names;
  for (const ParameterSymbol& symbol : parameters) names.push_back(symbol.parameter.name);
  return names;
}

std::vector<std::string> Symbols::frame_names() const {
  std::vector<std::string> names;
  for (const FrameSymbol& symbol : frames) names.push_back(symbol.declaration.name);
  return names;
}

}  // namespace zwang::lang

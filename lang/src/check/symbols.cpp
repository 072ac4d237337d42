#include "check/symbols.hpp"

#include <algorithm>

namespace zwang::lang {

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

/// A value whose place tells what it measures.
#pragma once

#include <optional>
#include <string>

#include "spec/value.hpp"

namespace zwang::lang {

/// As `parse_value`. The dimension tells which unit was meant: `20 Nm` of a force is `20 N`.
ValueText parse_measured_value(const Node& node, const std::string& what,
                               const std::optional<Dimension>& measured, Diagnostics& diagnostics);

}  // namespace zwang::lang

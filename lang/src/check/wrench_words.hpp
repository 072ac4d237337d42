/// The words for the numbers of a wrench in conditions: `felt.x`, `estimated.tool.plane`.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "words/dimension.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::lang {

std::optional<WrenchPart> wrench_part_named(std::string_view word);
std::vector<std::string> wrench_part_names();
/// A force, or of rx, ry and rz a torque.
Dimension dimension_of(WrenchPart part);

}  // namespace zwang::lang

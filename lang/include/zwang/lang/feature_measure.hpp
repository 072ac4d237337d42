/// How a feature of a task file is measured.
#pragma once

#include "zwang/export.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::lang {

/// The measure of the feature and its axes; the frames of `c` are the caller's.
ZWANG_EXPORT void set_measure(solver::AxisConstraint& c, const Feature& feature);

}  // namespace zwang::lang

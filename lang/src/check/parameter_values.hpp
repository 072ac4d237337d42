/// Requirements of a place on every value that a parameter may take there.
#pragma once

#include <string>

#include "check/context.hpp"

namespace zwang::lang {

/// The value at the start, where it can be read and measures what is expected.
std::optional<double> known_value(const CheckContext& context, const ValueText& value,
                                  const Dimension& expected);

/// The values that it can take, SI: of a parameter its range, or without one those that the file gives it.
solver::Range values_of(const CheckContext& context, const ValueText& value);

/// A bound that a place sets to its value, in words as "`c.x.stiffness` must be above 0".
struct Need {
  std::string rule;
  double limit = 0.0;    ///< SI
  bool is_least = true;  ///< false: the value must not be larger
  bool or_equal = true;
};
/// E206 where a parameter may take a value that breaks the bound. Of one without a range, the bound is kept
/// for whoever sets it later. The value at the start keeps it: that was asked before.
void require(CheckContext& context, const ValueText& value, const Need& need);
/// `require` of a value that must be above 0, or, with `zero_allowed`, not below 0.
void require_positive(CheckContext& context, const ValueText& value, const std::string& what,
                      bool zero_allowed);
/// `require` of two values: `low` must not be above `high`.
void require_order(CheckContext& context, const ValueText& low, const ValueText& high,
                   const std::string& rule);

/// Gathers the values that `set` gives parameters without a range. Asked once all are declared.
void gather_set_values(CheckContext& context);

/// `0.2 m/s`, `-$pace`: as the author wrote a quantity or a parameter.
std::string as_written(const ValueText& value);

}  // namespace zwang::lang

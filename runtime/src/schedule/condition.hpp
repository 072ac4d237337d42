/// Conditions of the task language, evaluated in three values.
#pragma once

#include <vector>

#include "schedule/frame_table.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::runtime {

enum class Verdict { no, yes, unknown };

/// What a condition may ask about.
class Facts {
 public:
  virtual double coordinate(int group, int axis, lang::CoordinateQuantity what) const noexcept = 0;
  virtual double elapsed() const noexcept = 0;
  virtual double parameter(int index) const noexcept = 0;
  virtual double speed(int frame) const noexcept = 0;
  virtual double moved(int frame) const noexcept = 0;

 protected:
  ~Facts() = default;
};

/// Does not allocate: `scratch` holds one number for each node and is at least as long. An operand that is
/// not a number is unknown, and so is what it decides.
Verdict evaluate(const lang::Condition& condition, const Facts& facts, std::vector<double>& scratch) noexcept;

}  // namespace zwang::runtime

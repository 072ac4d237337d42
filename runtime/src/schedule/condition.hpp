/// Conditions of the task language, evaluated in three values.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "zwang/lang/program.hpp"
#include "zwang/runtime/why.hpp"

namespace zwang::runtime {

/// The present value of a name in a condition.
struct Fact {
  double value = std::numeric_limits<double>::quiet_NaN();  ///< SI, or 0 and 1; not finite: unknown
  bool stale = false;  ///< unknown because a signal is older than its `stale_after`
};

/// The facts that a condition may ask about.
class Facts {
 public:
  /// `owner`: the task whose groups the condition speaks of.
  virtual Fact look_up(const lang::ExpressionNode& node, int owner) const noexcept = 0;

 protected:
  ~Facts() = default;
};

struct Judgement {
  Verdict verdict = Verdict::no;
  bool stale = false;  ///< a stale signal is among what the condition asks about
};

/// Does not allocate: `values` is at least as long as there are nodes. Afterwards it holds the value of each:
/// a number, 0 for false and 1 for true, NaN for unknown. An operand that is not a number is unknown, and so
/// is the result that depends on it. `release` replaces the threshold of a comparison.
Judgement evaluate(const lang::Condition& condition, int owner, const Facts& facts, std::span<double> values,
                   std::optional<double> release = std::nullopt) noexcept;

/// The names in the conditions of one task: a name that several conditions have is looked up once a tick.
class SharedNames {
 public:
  /// The index of the name; one that is new joins them. Allocates.
  int add(const lang::ExpressionNode& name);
  /// A new tick: nothing has been looked up yet.
  void forget() noexcept;
  const Fact& look_up(int name, int owner, const Facts& facts) noexcept;

 private:
  struct Name {
    lang::ExpressionNode node;
    Fact fact;
    bool is_known = false;
  };
  std::vector<Name> names_;
};

/// A condition as guards evaluate it: node by node, until one of them decides it.
class Decision {
 public:
  Decision(const lang::Condition& condition, SharedNames& names);

  /// As `evaluate`. Returns early where the rest cannot change the verdict: `is_whole` is false then, and
  /// `values` holds nothing new of the nodes behind.
  Judgement decide(int owner, const Facts& facts, SharedNames& names, std::span<double> values,
                   std::optional<double> release, bool& is_whole) const noexcept;

 private:
  struct Step {
    lang::Op op = lang::Op::constant;
    double number = 0.0;
    int left = -1, right = -1;
    int name = -1;                         ///< of the shared names
    std::optional<Verdict> if_false = {};  ///< of the condition, once this node is false
    std::optional<Verdict> if_true = {};
  };
  void mark(int node, std::optional<Verdict> if_false, std::optional<Verdict> if_true);
  std::vector<Step> steps_;
};

}  // namespace zwang::runtime

#include "check/condition_names.hpp"

#include <algorithm>
#include <array>

#include "check/wrench_words.hpp"
#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_forces.hpp"
#include "diagnostic/wordings_habits.hpp"
#include "diagnostic/wordings_slips.hpp"
#include "words/nearest.hpp"
#include "words/text.hpp"

namespace zwang::lang {

namespace {

struct CoordinateWord {
  std::string_view word;
  CoordinateQuantity quantity;
};
constexpr std::array coordinate_words{
    CoordinateWord{"position", CoordinateQuantity::position},
    CoordinateWord{"velocity", CoordinateQuantity::velocity},
    CoordinateWord{"force", CoordinateQuantity::force},
    CoordinateWord{"residual", CoordinateQuantity::residual},
    CoordinateWord{"saturated", CoordinateQuantity::saturated},
};

// In the order of the axis of Op::estimated_force.
constexpr std::array estimated_forces{"estimated.force.x", "estimated.force.y", "estimated.force.rz"};

Type type_of_coordinate(CoordinateQuantity what, solver::Axis axis) {
  switch (what) {
    case CoordinateQuantity::position:
      return quantity_type(dimension_of(axis, solver::Quantity::position));
    case CoordinateQuantity::velocity:
      return quantity_type(dimension_of(axis, solver::Quantity::velocity));
    case CoordinateQuantity::force:
      return quantity_type(dimension_of(axis, solver::Quantity::force));
    case CoordinateQuantity::residual:
      return quantity_type(dimension_of(axis, solver::Quantity::acceleration));
    case CoordinateQuantity::saturated:
      break;
  }
  return boolean_type;
}

/// The symbol that a name stands for. It counts as used, and the node refers to it.
template <typename Symbol>
const Symbol& referred(std::vector<Symbol>& symbols, Op op, int index, ExpressionNode& lowered) {
  Symbol& symbol = symbols[static_cast<std::size_t>(index)];
  symbol.is_used = true;
  lowered.op = op;
  lowered.index = index;
  return symbol;
}

}  // namespace

Type ConditionNames::complain(Diagnostic diagnostic) {
  context_.diagnostics.add(std::move(diagnostic));
  return bad_type;
}

Type ConditionNames::type_of(const ExpressionText& node, ExpressionNode& lowered) {
  const Symbols& symbols = context_.symbols;
  if (node.word == "elapsed") {
    lowered.op = Op::elapsed;
    return quantity_type(dimension::time);
  }
  if (const auto signal = symbols.find_signal(node.word)) return check_signal(node, *signal, lowered);
  if (const auto output = symbols.find_output(node.word)) return check_output(*output, lowered);
  if (const auto feature = symbols.find_feature(node.word)) return check_feature(*feature, lowered);
  if (const auto force = check_estimated_force(node, lowered)) return *force;
  std::vector<std::string> parts = split_at_dots(node.word);
  if (context_.of_truth && parts.size() > 1) {
    return complain(wording::unknown_truth(node.span, node.word, truth_meant(node.word)));
  }
  if (const auto wrench = check_wrench(node, parts, lowered)) return *wrench;
  // Of a group on a feature, the group's name says it all: `near.velocity`.
  if (const GroupText* group = find_group(parts[0], lowered)) {
    const bool is_feature = group->kind == GroupKind::feature;
    if (is_feature && parts.size() == 3)
      return complain(wording::axis_of_a_feature(node.span, parts[0], parts[2]));
    if (is_feature && parts.size() == 2) parts.insert(parts.begin(), parts[0]);
  }
  if (parts.size() == 3) return check_coordinate(node, parts, lowered);
  return type_of_unknown(node, parts);
}

Type ConditionNames::type_of_unknown(const ExpressionText& node, const std::vector<std::string>& parts) {
  if (has_unread_name()) return bad_type;
  if (parts.size() == 2 && context_.symbols.find_feature(parts[0]))
    return complain(wording::quantity_of_a_feature(node.span, node.word, parts[0]));
  if (!context_.of_truth) {
    if (const auto slip = slip_of_a_name(node, parts)) return complain(*slip);
  }
  if (const auto word = wording::word_for_a_condition(node.span, node.word)) return complain(*word);
  const std::string near = nearest(node.word, known_names());
  for (const char* touch : {"contact", "collision", "touched", "touch", "bumper", "in_contact"}) {
    if (node.word == touch && near.empty() && !context_.of_truth)
      return complain(wording::contact_in_a_condition(node.span, node.word));
  }
  return complain(wording::unknown_quantity(node.span, node.word, near));
}

std::vector<std::string> ConditionNames::known_names() const {
  std::vector<std::string> known{"elapsed"};
  if (!context_.of_truth) known.insert(known.end(), estimated_forces.begin(), estimated_forces.end());
  for (const SignalSymbol& symbol : context_.symbols.signals) {
    known.push_back(symbol.signal.name);
    if (symbol.signal.type != SignalType::wrench) continue;
    for (const std::string& part : wrench_part_names()) known.push_back(symbol.signal.name + "." + part);
  }
  for (const std::string& name : context_.symbols.output_names()) known.push_back(name);
  for (const std::string& name : context_.symbols.feature_names()) known.push_back(name);
  for (const GroupText& group : groups_) {
    for (const AxisText& axis : group.axes) {
      for (const CoordinateWord& word : coordinate_words) {
        const std::string axis_of = group.kind == GroupKind::feature ? "" : "." + axis.name.text;
        known.push_back(group.name.text + axis_of + "." + std::string(word.word));
      }
    }
  }
  return known;
}

/// `base.yaw` and `truth.base.theta` for `truth.base.yaw`.
std::string ConditionNames::truth_meant(const std::string& written) const {
  const std::vector<std::string> names = context_.symbols.signal_names();
  if (std::find(names.begin(), names.end(), "truth." + written) != names.end()) return "truth." + written;
  const std::string owner = written.substr(0, written.rfind('.') + 1);
  std::vector<std::string> words;
  for (const std::string& name : names) {
    if (name.starts_with(owner)) words.push_back(name.substr(owner.size()));
  }
  const std::string word = meant_key(written.substr(owner.size()), words);
  return word.empty() ? nearest(written, names) : owner + word;
}

/// A name that means something, elsewhere or with a word more.
std::optional<Diagnostic> ConditionNames::slip_of_a_name(const ExpressionText& node,
                                                         const std::vector<std::string>& parts) {
  if (context_.symbols.find_parameter(node.word) != nullptr)
    return wording::parameter_without_dollar(node.span, node.word);
  if (parts.size() > 2) return std::nullopt;
  if (parts[0] == "params" && context_.symbols.find_parameter(parts[1]) != nullptr)
    return wording::parameter_without_dollar(node.span, parts[1]);
  ExpressionNode unused;
  const GroupText* group = find_group(parts[0], unused);
  if (group != nullptr && group->kind == GroupKind::inside)
    return wording::boundary_in_a_condition(node.span, parts[0], group->move.text);
  const bool names_axis = group != nullptr && parts.size() == 2 &&
                          std::any_of(group->axes.begin(), group->axes.end(),
                                      [&](const AxisText& axis) { return axis.name.text == parts[1]; });
  if (names_axis) return wording::axis_without_quantity(node.span, node.word);
  if (group == nullptr && context_.symbols.find_frame(parts[0]))
    return wording::frame_for_a_quantity(node.span, node.word, parts[0]);
  return std::nullopt;
}

Type ConditionNames::check_signal(const ExpressionText& node, int index, ExpressionNode& lowered) {
  const SignalSymbol& symbol = referred(context_.symbols.signals, Op::signal, index, lowered);
  if (symbol.is_bad) return bad_type;
  switch (symbol.signal.type) {
    case SignalType::boolean:
      return boolean_type;
    case SignalType::number:
      return quantity_type(symbol.dimension);
    case SignalType::pose:
    case SignalType::wrench:
      break;
  }
  return complain(wording::incomparable_signal(node.span, node.word, symbol.signal.type == SignalType::pose));
}

Type ConditionNames::check_output(int index, ExpressionNode& lowered) {
  const OutputSymbol& symbol = referred(context_.symbols.outputs, Op::output, index, lowered);
  if (symbol.is_bad) return bad_type;
  return symbol.output.is_number ? quantity_type(symbol.dimension) : boolean_type;
}

Type ConditionNames::check_feature(int index, ExpressionNode& lowered) {
  const FeatureSymbol& symbol = referred(context_.symbols.features, Op::feature, index, lowered);
  if (symbol.is_bad) return bad_type;
  return quantity_type(symbol.feature.turns ? dimension::angle : dimension::length);
}

/// `estimated.force.x`: on the base.
std::optional<Type> ConditionNames::check_estimated_force(const ExpressionText& node,
                                                          ExpressionNode& lowered) {
  for (int axis = 0; axis < 3 && !context_.of_truth; ++axis) {
    if (node.word != estimated_forces[static_cast<std::size_t>(axis)]) continue;
    if (context_.robot && context_.robot->drive.takes_velocity && !context_.robot->drive.feels_contact())
      return complain(wording::estimate_without_torque(node.span, node.word));
    lowered.op = Op::estimated_force;
    lowered.axis = axis;
    return quantity_type(axis < 2 ? dimension::force : dimension::torque);
  }
  return std::nullopt;
}

/// `felt.x` of a wrench signal, and `estimated.tool.x` of a frame. A group's name goes first.
std::optional<Type> ConditionNames::check_wrench(const ExpressionText& node,
                                                 const std::vector<std::string>& parts,
                                                 ExpressionNode& lowered) {
  if (parts.size() < 2 || parts.size() > 3) return std::nullopt;
  ExpressionNode of_group;
  if (find_group(parts[0], of_group) != nullptr) return std::nullopt;
  const bool is_estimated = parts[0] == "estimated" && parts.size() == 3;
  const std::optional<int> signal = parts.size() == 2 ? context_.symbols.find_signal(parts[0]) : std::nullopt;
  const bool is_felt =
      signal && context_.symbols.signals[static_cast<std::size_t>(*signal)].signal.type == SignalType::wrench;
  if (!is_estimated && !is_felt) return std::nullopt;
  const std::optional<WrenchPart> part = wrench_part_named(parts.back());
  if (!part) {
    const std::string before = node.word.substr(0, node.word.size() - parts.back().size());
    std::vector<std::string> known;
    for (const std::string& name : wrench_part_names()) known.push_back(before + name);
    return complain(wording::unknown_name(node.span, "part of a wrench", node.word, known));
  }
  if (is_estimated) return check_estimated_wrench(node, parts[1], *part, lowered);
  context_.symbols.signals[static_cast<std::size_t>(*signal)].is_used = true;
  lowered.op = Op::signal;
  lowered.index = *signal;
  lowered.axis = static_cast<int>(*part);
  return quantity_type(dimension_of(*part));
}

Type ConditionNames::check_estimated_wrench(const ExpressionText& node, const std::string& name,
                                            WrenchPart part, ExpressionNode& lowered) {
  if (name == "force")  // of another axis than the three
    return complain(wording::unknown_quantity(node.span, node.word, nearest(node.word, known_names())));
  const std::optional<int> frame = check_frame(context_, {name, node.span});
  if (!frame) return bad_type;
  const int body = context_.symbols.frames[static_cast<std::size_t>(*frame)].body;
  if (body < 0) return complain(wording::wrench_on_the_world(node.span, name));
  if (context_.robot) {
    const Drive& drive = context_.robot->drive;
    if (drive.takes_velocity && (!drive.feels_contact() || body > 0))
      return complain(wording::estimate_without_torque(node.span, node.word));
    const bool is_on_wheels = body == 0 && !context_.robot->model.has_fixed_base();
    const bool is_borne = part == WrenchPart::z || part == WrenchPart::rx || part == WrenchPart::ry;
    if (is_on_wheels && is_borne) return complain(wording::wrench_that_the_floor_bears(node.span, node.word));
  }
  lowered.op = Op::estimated_wrench;
  lowered.index = *frame;
  lowered.axis = static_cast<int>(part);
  return quantity_type(dimension_of(part));
}

/// The group of the task, or else of `always`, that a path starts with.
const GroupText* ConditionNames::find_group(const std::string& name, ExpressionNode& lowered) const {
  for (const auto* groups : {&groups_, &context_.file.always_groups}) {
    for (std::size_t g = 0; g < groups->size(); ++g) {
      if ((*groups)[g].name.text != name) continue;
      lowered.index = static_cast<int>(g);
      lowered.in_always = groups != &groups_;
      return &(*groups)[g];
    }
  }
  return nullptr;
}

/// A group without a name may be the one that is meant; it was complained of.
bool ConditionNames::has_unread_group() const {
  for (const auto* groups : {&groups_, &context_.file.always_groups}) {
    for (const GroupText& group : *groups) {
      if (!group.name.exists()) return true;
    }
  }
  return false;
}

/// A signal or feature whose name could not be read may be the one that is meant; it was complained of.
bool ConditionNames::has_unread_name() const {
  const auto is_unread = [](const auto& text) { return !text.name.exists(); };
  const auto& file = context_.file;
  return std::any_of(file.signals.begin(), file.signals.end(), is_unread) ||
         std::any_of(file.outputs.begin(), file.outputs.end(), is_unread) ||
         std::any_of(file.features.begin(), file.features.end(), is_unread);
}

Type ConditionNames::check_coordinate(const ExpressionText& node, const std::vector<std::string>& parts,
                                      ExpressionNode& lowered) {
  std::vector<std::string> known;
  const GroupText* found = find_group(parts[0], lowered);
  if (found == nullptr && has_unread_group()) return bad_type;
  if (found == nullptr) {
    for (const GroupText& group : groups_) known.push_back(group.name.text);
    Diagnostic unknown = wording::unknown_name(node.span, "group", parts[0], known);
    const std::string near = nearest(parts[0], known);
    if (!near.empty()) unknown.replacement = near + node.word.substr(parts[0].size());
    return complain(std::move(unknown));
  }
  const GroupText& group = *found;
  if (group.kind == GroupKind::inside)
    return complain(wording::boundary_in_a_condition(node.span, parts[0], group.move.text));
  for (std::size_t a = 0; a < group.axes.size(); ++a) {
    known.push_back(group.axes[a].name.text);
    if (group.axes[a].name.text == parts[1]) lowered.axis = static_cast<int>(a);
  }
  if (lowered.axis < 0 && group.is_incomplete) return bad_type;
  if (lowered.axis < 0) {
    return complain(
        wording::unknown_axis(node.span, parts[0], parts[1], axis_named(parts[1]).has_value(), known));
  }
  lowered.op = Op::coordinate;
  known.clear();
  for (const CoordinateWord& word : coordinate_words) {
    known.emplace_back(word.word);
    if (word.word != parts[2]) continue;
    lowered.what = word.quantity;
    return type_of_coordinate(word.quantity, axis_measured(group, parts[1]));
  }
  Diagnostic unknown = wording::unknown_name(node.span, "quantity", parts[2], known);
  const std::string meant = meant_key(parts[2], known);
  if (!meant.empty()) {
    unknown.help = "did you mean `" + meant + "`?";
    unknown.replacement = parts[0] + "." + parts[1] + "." + meant;
  }
  if (const auto word = wording::word_for_a_condition(node.span, node.word)) unknown.help = word->help;
  return complain(std::move(unknown));
}

/// The axis itself; of a feature any that measures alike.
solver::Axis ConditionNames::axis_measured(const GroupText& group, const std::string& axis) const {
  if (group.kind != GroupKind::feature) return axis_named(axis).value_or(solver::Axis::x);
  const std::optional<int> index = context_.symbols.find_feature(group.feature.text);
  const bool turns = index && context_.symbols.features[static_cast<std::size_t>(*index)].feature.turns;
  return turns ? solver::Axis::rz : solver::Axis::x;
}

}  // namespace zwang::lang

#include <algorithm>

#include "check/context.hpp"
#include "check/parameter_values.hpp"
#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_habits.hpp"
#include "diagnostic/wordings_slips.hpp"
#include "spec/parse_task.hpp"
#include "words/text.hpp"

namespace zwang::lang {

namespace {

/// A parameter's range, SI; nullopt when there is none or it is bad.
std::optional<solver::Range> check_range(CheckContext& context, const ParameterText& text,
                                         const Dimension& dimension) {
  if (!text.range) return std::nullopt;
  const std::string what = "the range of parameter `" + text.name.text + "`";
  for (const ValueText* end : {&text.range->low, &text.range->high}) {
    if (!require_quantity(*end, dimension, what, context.diagnostics)) return std::nullopt;
  }
  const Quantity& low = text.range->low.quantity;
  const Quantity& high = text.range->high.quantity;
  if (low.value > high.value) {
    context.diagnostics.add(
        wording::empty_range(text.range->span, low.number + " " + low.unit, high.number + " " + high.unit));
    return std::nullopt;
  }
  return solver::Range{low.value, high.value};
}

ParameterSymbol check_parameter(CheckContext& context, const ParameterText& text) {
  ParameterSymbol symbol;
  symbol.parameter.name = text.name.text;
  symbol.parameter.help = text.help;
  symbol.parameter.span = text.name.span;
  symbol.is_bad = text.value.kind != ValueKind::quantity;
  if (symbol.is_bad) {
    if (text.value.kind != ValueKind::bad) {
      context.diagnostics.add(wording::parameter_needs_quantity(text.value.span, text.name.text));
    }
    return symbol;
  }
  const Quantity& quantity = text.value.quantity;
  // The range has a unit and the value has none: what the parameter measures is known, and what is missing.
  const bool has_range = text.range && text.range->low.kind == ValueKind::quantity;
  if (!quantity.has_unit && has_range && text.range->low.quantity.has_unit) {
    symbol.is_bad = true;
    context.diagnostics.add(wording::needs_unit(text.value.span, "parameter `" + text.name.text + "`",
                                                quantity.number, text.range->low.quantity.dimension));
    return symbol;
  }
  symbol.dimension = quantity.dimension;
  symbol.parameter.value = quantity.value;
  symbol.parameter.unit = quantity.unit;
  symbol.parameter.unit_scale = quantity.scale;
  const int errors_before = context.diagnostics.error_count();
  symbol.parameter.range = check_range(context, text, quantity.dimension);
  // Which of the two is wrong is not known, nor what the parameter measures then.
  symbol.is_bad = context.diagnostics.error_count() > errors_before;
  const auto& range = symbol.parameter.range;
  const auto& given = context.options.given;
  const bool is_overridden = context.options.parameters.contains(text.name.text) ||
                             std::any_of(given.begin(), given.end(), [&](const GivenParameter& other) {
                               return other.name == text.name.text;
                             });
  if (range && !is_overridden && (quantity.value < range->low || quantity.value > range->high)) {
    context.diagnostics.add(wording::outside_range(text.value.span, symbol.parameter, quantity.value));
  }
  return symbol;
}

/// `-p name=value`, as if it stood in a file.
GivenParameter from_command_line(CheckContext& context, const std::string& name, const std::string& text) {
  const std::string written = name + "=" + text;
  const int source = context.diagnostics.add_source({"-p", written});
  const auto column = [&](std::size_t offset) {
    return static_cast<int>(count_code_points(written.substr(0, offset))) + 1;
  };
  const Span name_span{source, {1, 1}, {1, column(name.size())}};
  const Span value_span{source, {1, column(name.size() + 1)}, {1, column(written.size())}};
  return {name, text, name_span, value_span};
}

/// In the place of the file's own value.
void apply_override(CheckContext& context, const GivenParameter& given) {
  const std::string& name = given.name;
  ParameterSymbol* symbol = context.symbols.find_parameter(name);
  if (symbol == nullptr) {
    context.diagnostics.add(
        wording::unknown_name(given.name_span, "parameter", name, context.symbols.parameter_names()));
    return;
  }
  const Word value{given.value, given.value_span};
  if (const auto number = check_parameter_value(*symbol, value, context.diagnostics))
    symbol->parameter.value = *number;
}

/// Whether the file has a frame or signal of this name: it means its own then, as it did before robots had
/// `base` and `lead`.
bool has_own(const TaskFile& file, const std::string& name) {
  const auto is_it = [&](const auto& item) { return item.name.text == name; };
  return std::any_of(file.frames.begin(), file.frames.end(), is_it) ||
         std::any_of(file.signals.begin(), file.signals.end(), is_it);
}

void add_robot_frames(CheckContext& context) {
  FrameSymbol world;
  world.declaration.name = "world";
  context.symbols.frames.push_back(world);
  if (!context.robot) return;
  const std::vector<std::string>& implied = context.robot->implied_frames;
  for (const solver::Frame& frame : context.robot->model.frames()) {
    const bool is_implied = std::find(implied.begin(), implied.end(), frame.name) != implied.end();
    if (is_implied && has_own(context.file, frame.name)) continue;
    FrameSymbol symbol;
    symbol.declaration.name = frame.name;
    symbol.declaration.parent = FrameParent::body;
    symbol.declaration.parent_index = frame.body;
    symbol.declaration.pose = frame.pose_in_body;
    symbol.body = frame.body;
    context.symbols.frames.push_back(std::move(symbol));
  }
}

/// Frames in an order in which parents stand before children; what is left over hangs in a loop.
class FrameOrder {
 public:
  explicit FrameOrder(CheckContext& context) : context_(context) {
    for (const FrameText& frame : context.file.frames) {
      if (frame.name.exists() && !context.symbols.find_frame(frame.name.text)) waiting_.push_back(&frame);
    }
  }

  void place_all() {
    for (bool is_growing = true; is_growing;) {
      is_growing = false;
      for (const FrameText*& frame : waiting_) {
        if (frame == nullptr || waits_for_another(*frame)) continue;
        place(*frame);
        frame = nullptr;
        is_growing = true;
      }
    }
    std::erase(waiting_, nullptr);
    report_loops();
  }

 private:
  bool waits_for_another(const FrameText& frame) const { return find_waiting(frame.parent.text) != nullptr; }

  const FrameText* find_waiting(const std::string& name) const {
    for (const FrameText* frame : waiting_) {
      if (frame != nullptr && frame->name.text == name) return frame;
    }
    return nullptr;
  }

  void place(const FrameText& frame) {
    FrameSymbol symbol;
    symbol.is_declared = true;
    symbol.declaration.name = frame.name.text;
    symbol.declaration.span = frame.span;
    symbol.declaration.pose = pose_of(frame);
    if (frame.is_path) symbol.path = path_named(frame.name.text);
    if (hangs_on_signal(frame, symbol)) {
      context_.symbols.frames.push_back(std::move(symbol));
      return;
    }
    const std::optional<int> parent = find_parent(frame.parent);
    symbol.is_bad = !parent;
    if (parent) {
      symbol.body = context_.symbols.frames[static_cast<std::size_t>(*parent)].body;
      symbol.declaration.parent = *parent == 0 ? FrameParent::world : FrameParent::frame;
      symbol.declaration.parent_index = *parent == 0 ? -1 : *parent;
    }
    context_.symbols.frames.push_back(std::move(symbol));
  }

  int path_named(const std::string& name) const {
    const std::vector<Path>& paths = context_.file.paths;
    const auto is_it = [&](const Path& path) { return path.name == name; };
    return static_cast<int>(std::find_if(paths.begin(), paths.end(), is_it) - paths.begin());
  }

  /// A frame may hang on another frame or on a pose signal, so the message offers both.
  std::optional<int> find_parent(const Word& name) {
    const Symbols& symbols = context_.symbols;
    if (!name.exists() || symbols.find_frame(name.text) || !symbols.has_robot)
      return check_frame(context_, name);
    std::vector<std::string> known = symbols.frame_names();
    for (const SignalSymbol& signal : symbols.signals) {
      if (signal.signal.type == SignalType::pose) known.push_back(signal.signal.name);
    }
    context_.diagnostics.add(wording::unknown_frame(name.span, "frame", name.text, known, base_of(context_)));
    return std::nullopt;
  }

  /// A pose signal is a place in the world that moves when a new sample comes.
  bool hangs_on_signal(const FrameText& frame, FrameSymbol& symbol) {
    if (context_.symbols.find_frame(frame.parent.text)) return false;
    const std::optional<int> index = context_.symbols.find_signal(frame.parent.text);
    if (!index) return false;
    SignalSymbol& signal = context_.symbols.signals[static_cast<std::size_t>(*index)];
    signal.is_used = true;
    symbol.is_bad = signal.is_bad;
    if (!signal.is_bad && signal.signal.type != SignalType::pose) {
      context_.diagnostics.add(
          wording::not_a_pose_signal(frame.parent.span, frame.parent.text, signal.signal.span));
      symbol.is_bad = true;
    }
    symbol.declaration.parent = FrameParent::signal;
    symbol.declaration.parent_index = *index;
    return true;
  }

  void report_loop(const std::vector<const FrameText*>& loop) {
    const std::optional<int> signal = context_.symbols.find_signal(loop[0]->name.text);
    if (signal && loop[0]->parent.text == loop[0]->name.text) {
      SignalSymbol& hidden = context_.symbols.signals[static_cast<std::size_t>(*signal)];
      hidden.is_used = true;
      context_.diagnostics.add(
          wording::frame_hides_signal(loop[0]->span, loop[0]->name.text, hidden.signal.span));
      return;
    }
    std::vector<std::string> names;
    for (const FrameText* part : loop) names.push_back(part->name.text);
    context_.diagnostics.add(wording::frame_loop(loop[0]->span, names));
  }

  void report_loops() {
    for (const FrameText* frame : waiting_) {
      // Each loop once, from its first frame; what only hangs on a loop is not complained of.
      std::vector<const FrameText*> loop{frame};
      while (std::count(loop.begin(), loop.end(), loop.back()) == 1) {
        loop.push_back(find_waiting(loop.back()->parent.text));
      }
      const bool is_in_loop = loop.back() == frame;
      const bool is_first =
          is_in_loop && std::all_of(loop.begin(), loop.end(), [&](const FrameText* other) {
            const Position& first = frame->span.begin;
            const Position& begin = other->span.begin;
            return std::pair(begin.line, begin.column) >= std::pair(first.line, first.column);
          });
      if (is_first) {
        report_loop(loop);
      }
      FrameSymbol bad;
      bad.is_declared = bad.is_bad = bad.is_used = true;
      bad.declaration.name = frame->name.text;
      context_.symbols.frames.push_back(std::move(bad));
    }
  }

  CheckContext& context_;
  std::vector<const FrameText*> waiting_;
};

}  // namespace

std::optional<double> check_parameter_value(const ParameterSymbol& symbol, const Word& text,
                                            Diagnostics& diagnostics) {
  if (symbol.is_bad) return std::nullopt;
  Node node;
  node.kind = NodeKind::scalar;
  node.span = text.span;
  node.text = text.text;
  const std::string what = "parameter `" + symbol.parameter.name + "`";
  const ValueText value = parse_value(node, what, diagnostics);
  if (!require_quantity(value, symbol.dimension, what, diagnostics)) return std::nullopt;
  const double number = value.quantity.value;
  const auto& range = symbol.parameter.range;
  if (range && (number < range->low || number > range->high)) {
    diagnostics.add(wording::outside_range(text.span, symbol.parameter, number));
    return std::nullopt;
  }
  return number;
}

void check_parameters(CheckContext& context) {
  for (const ParameterText& text : context.file.parameters) {
    if (text.name.exists()) context.symbols.parameters.push_back(check_parameter(context, text));
  }
  for (const GivenParameter& given : context.options.given) apply_override(context, given);
  for (const auto& [name, text] : context.options.parameters)
    apply_override(context, from_command_line(context, name, text));
  gather_set_values(context);
}

namespace {

/// A path is a frame, too: one of `frames` cannot have its name.
void check_names_of_paths(CheckContext& context) {
  const std::vector<FrameText>& frames = context.file.frames;
  for (const FrameText& path : frames) {
    if (!path.is_path) continue;
    const auto is_taken = [&](const FrameText& frame) {
      return !frame.is_path && frame.name.text == path.name.text;
    };
    if (std::any_of(frames.begin(), frames.end(), is_taken))
      context.diagnostics.add(wording::name_taken(path.span, path.name.text, "a frame"));
  }
}

}  // namespace

void check_frames(CheckContext& context) {
  add_robot_frames(context);
  check_names_of_paths(context);
  for (const FrameText& frame : context.file.frames) {
    const std::optional<int> taken = context.symbols.find_frame(frame.name.text);
    if (!taken) continue;
    const std::string owner = *taken == 0 ? "the frame that everything stands in" : "a frame of the robot";
    context.diagnostics.add(wording::name_taken(frame.span, frame.name.text, owner));
  }
  FrameOrder(context).place_all();
}

}  // namespace zwang::lang

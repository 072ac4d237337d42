#include "parameters.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace zwang::connect {

namespace {

/// rcl_interfaces/ParameterType.
enum ParameterType : std::uint8_t { type_not_set = 0, type_integer = 2, type_double = 3 };

/// rcl_interfaces/ParameterValue.
struct ParameterValue {
  std::uint8_t type = type_not_set;
  bool boolean = false;
  std::int64_t integer = 0;
  double number = 0.0;
  std::string text;
  std::vector<std::uint8_t> octets, booleans;
  std::vector<std::int64_t> integers;
  std::vector<double> numbers;
  std::vector<std::string> texts;
};

template <typename Way, typename Value>
void pass_value(Way& way, Value& v) {
  way(v.type), way(v.boolean), way(v.integer), way(v.number), way(v.text);
  way(v.octets), way(v.booleans), way(v.integers), way(v.numbers), way(v.texts);
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

}  // namespace

std::uint8_t ParameterServer::type_of(const Known* known) {
  return known != nullptr ? type_double : type_not_set;
}

void ParameterServer::serve_for(const lang::Program& program) {
  const std::lock_guard lock(mutex_);
  known_.clear();
  for (const lang::Parameter& parameter : program.parameters) known_.push_back({parameter});
}

std::optional<ParameterServer::Change> ParameterServer::take_change() noexcept {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) return std::nullopt;  // in the next tick
  for (std::size_t i = 0; i < known_.size(); ++i) {
    if (!known_[i].is_changed) continue;
    known_[i].is_changed = false;
    return Change{i, known_[i].parameter.value};
  }
  return std::nullopt;
}

ParameterServer::Known* ParameterServer::find(const std::string& name) {
  const auto known =
      std::find_if(known_.begin(), known_.end(), [&](const Known& k) { return k.parameter.name == name; });
  return known == known_.end() ? nullptr : &*known;
}

/// No parameter has a dot in its name, so prefixes other than a whole name lead nowhere.
void ParameterServer::list(std::span<const std::uint8_t> fields, const Reply& reply) {
  CdrReader read(fields);
  std::vector<std::string> prefixes;
  std::uint64_t depth = 0;
  read(prefixes), read(depth);
  if (!read.is_at_end()) return;
  std::vector<std::string> names;
  {
    const std::lock_guard lock(mutex_);
    for (const Known& known : known_) {
      const std::string& name = known.parameter.name;
      if (prefixes.empty() || std::find(prefixes.begin(), prefixes.end(), name) != prefixes.end())
        names.push_back(name);
    }
  }
  Bytes answer;
  CdrWriter write(answer);
  write(names), write(std::vector<std::string>());
  reply(answer);
}

/// A sequence: of each name that is asked for, what `tell` writes of it.
template <typename Tell>
void ParameterServer::answer_each(std::span<const std::uint8_t> fields, const Reply& reply, Tell tell) {
  CdrReader read(fields);
  std::vector<std::string> names;
  read(names);
  if (!read.is_at_end()) return;
  Bytes answer;
  CdrWriter write(answer);
  write(static_cast<std::uint32_t>(names.size()));
  {
    const std::lock_guard lock(mutex_);
    for (const std::string& name : names) tell(write, name, find(name));
  }
  reply(answer);
}

void ParameterServer::get(std::span<const std::uint8_t> fields, const Reply& reply) {
  answer_each(fields, reply, [](CdrWriter& write, const std::string&, const Known* known) {
    ParameterValue value;
    value.type = type_of(known);
    if (known != nullptr) value.number = known->parameter.value;
    pass_value(write, value);
  });
}

void ParameterServer::get_types(std::span<const std::uint8_t> fields, const Reply& reply) {
  answer_each(fields, reply,
              [](CdrWriter& write, const std::string&, const Known* known) { write(type_of(known)); });
}

/// rcl_interfaces/ParameterDescriptor of each name.
void ParameterServer::describe(std::span<const std::uint8_t> fields, const Reply& reply) {
  answer_each(fields, reply, [](CdrWriter& write, const std::string& name, const Known* known) {
    write(name), write(type_of(known));
    write(known != nullptr ? known->parameter.help : std::string());
    write(std::string(known != nullptr ? "in SI; the task file writes it in " + known->parameter.unit : ""));
    write(false), write(false);  // neither read only nor of a type that changes
    const bool has_range = known != nullptr && known->parameter.range;
    write(std::uint32_t{has_range ? 1U : 0U});
    if (has_range) write(known->parameter.range->low), write(known->parameter.range->high), write(0.0);
    write(std::uint32_t{0});  // ranges of integers
  });
}

std::optional<std::vector<ParameterServer::Wanted>> ParameterServer::read_wanted(
    std::span<const std::uint8_t> fields) {
  CdrReader read(fields);
  std::uint32_t count = 0;
  read(count);
  std::vector<Wanted> all;
  for (std::uint32_t i = 0; i < count && read.is_good(); ++i) {
    Wanted& wanted = all.emplace_back();
    ParameterValue value;
    read(wanted.name);
    pass_value(read, value);
    if (value.type == type_double) wanted.value = value.number;
    // `ros2 param set /zwang push 30` sends an integer.
    if (value.type == type_integer) wanted.value = static_cast<double>(value.integer);
  }
  if (!read.is_at_end()) return std::nullopt;
  return all;
}

ParameterServer::Verdict ParameterServer::judge(const Wanted& wanted) {
  const Known* known = find(wanted.name);
  if (known == nullptr) return {false, "the task has no parameter `" + wanted.name + "`"};
  if (!wanted.value || !std::isfinite(*wanted.value))
    return {false, "`" + wanted.name + "` is a number, in SI"};
  const auto& range = known->parameter.range;
  if (range && (*wanted.value < range->low || *wanted.value > range->high))
    return {false, "`" + wanted.name + "` is from " + short_number(range->low) + " to " +
                       short_number(range->high) + ", in SI"};
  return {};
}

void ParameterServer::take(const Wanted& wanted) {
  Known* known = find(wanted.name);
  known->parameter.value = *wanted.value;
  known->is_changed = true;
}

void ParameterServer::set(std::span<const std::uint8_t> fields, const Reply& reply) {
  const auto all = read_wanted(fields);
  if (!all) return;
  Bytes answer;
  CdrWriter write(answer);
  write(static_cast<std::uint32_t>(all->size()));
  {
    const std::lock_guard lock(mutex_);
    for (const Wanted& wanted : *all) {
      const Verdict verdict = judge(wanted);
      if (verdict.successful) take(wanted);
      write(verdict.successful), write(verdict.reason);
    }
  }
  reply(answer);
}

void ParameterServer::set_atomically(std::span<const std::uint8_t> fields, const Reply& reply) {
  const auto all = read_wanted(fields);
  if (!all) return;
  Verdict verdict;
  {
    const std::lock_guard lock(mutex_);
    for (const Wanted& wanted : *all) {
      if (verdict.successful) verdict = judge(wanted);
    }
    for (const Wanted& wanted : *all) {
      if (verdict.successful) take(wanted);
    }
  }
  Bytes answer;
  CdrWriter write(answer);
  write(verdict.successful), write(verdict.reason);
  reply(answer);
}

}  // namespace zwang::connect

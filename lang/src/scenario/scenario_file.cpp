#include "scenario/scenario_file.hpp"

#include <algorithm>
#include <map>

#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_habits.hpp"
#include "diagnostic/wordings_slips.hpp"
#include "diagnostic/wordings_study.hpp"
#include "scene/faults.hpp"
#include "spec/shape.hpp"
#include "words/nearest.hpp"
#include "words/text.hpp"
#include "zwang/lang/explanation.hpp"

namespace zwang::lang {

bool is_parameter(const std::string& key) {
  return key.starts_with("params.") && key.size() > 7;
}

namespace {

const std::vector<std::string> outcomes{"done",     "failed",  "stopped",   "fallen",
                                        "diverged", "refused", "unfinished"};

std::string stem(const std::string& path) {
  return std::filesystem::path(path).stem().string();
}

/// One value of the key `name`, whose kind follows from it.
std::optional<MatrixValue> parse_matrix_value(const std::string& name, const Node& node,
                                              Diagnostics& diagnostics) {
  MatrixValue value;
  value.word.span = node.span;
  const std::string what = "`" + name + "`";
  if (name == "start_at") {
    if (complain_of_third_value(node, what, "start_at", "start_yaw", false, diagnostics)) return std::nullopt;
    const auto at = parse_vector(node, dimension::length, 2, 2, what, diagnostics);
    if (!at) return std::nullopt;
    value.at = {(*at)[0], (*at)[1]};
    value.label = "start_at [" + node.items[0].text + ", " + node.items[1].text + "]";
    return value;
  }
  if (name == "start_yaw") {
    value.yaw = parse_plain(node, dimension::angle, what, diagnostics);
    if (!value.yaw) return std::nullopt;
    value.label = name + " " + node.text;
    return value;
  }
  value.word = parse_word(node, what, diagnostics);
  if (!value.word.exists()) return std::nullopt;
  const bool is_path = name == "robot" || name == "scene";
  const std::string key = is_parameter(name) ? name.substr(7) : name;
  value.label = key + " " + (is_path ? stem(node.text) : node.text);
  return value;
}

MatrixKey parse_matrix_key(const Entry& entry, Diagnostics& diagnostics) {
  MatrixKey key;
  key.name = entry.key.text;
  key.span = entry.key.span;
  if (entry.value.is_scalar() && !entry.value.is_bad && entry.value.text.find("..") == std::string::npos) {
    diagnostics.add(wording::vector_by_example(entry.value.span, "`matrix." + key.name + "`",
                                               "[" + entry.value.text + "]"));
    return key;
  }
  if (!require_sequence(entry.value, "`matrix." + key.name + "`", diagnostics)) return key;
  const auto is_bare = [](const Node& item) { return item.is_scalar(); };
  const auto& items = entry.value.items;
  if (key.name == "start_at" && items.size() > 1 && std::all_of(items.begin(), items.end(), is_bare)) {
    diagnostics.add(wording::place_for_a_list(entry.value.span, "`matrix.start_at`"));
    return key;
  }
  if (key.name == "start_yaw" &&
      complain_of_bare_numbers(entry.value, dimension::angle, "`matrix.start_yaw`", diagnostics))
    return key;
  for (const Node& item : entry.value.items) {
    if (auto value = parse_matrix_value(key.name, item, diagnostics)) key.values.push_back(std::move(*value));
  }
  if (entry.value.items.empty()) diagnostics.add(wording::empty_matrix_key(entry.value.span, key.name));
  return key;
}

void parse_matrix(const Node& node, ScenarioFile& file, Diagnostics& diagnostics) {
  MapReader map(node, "`matrix`", diagnostics);
  if (!map.is_mapping()) return;
  for (const Entry& entry : node.entries) {
    if (!entry.key.is_bad && is_parameter(entry.key.text)) map.optional(entry.key.text);
  }
  for (const char* name : {"robot", "scene", "start_at", "start_yaw", "faults"}) map.optional(name);
  for (const Entry& entry : node.entries) {
    const bool is_known = is_parameter(entry.key.text) || entry.key.text == "robot" ||
                          entry.key.text == "scene" || entry.key.text == "start_at" ||
                          entry.key.text == "start_yaw" || entry.key.text == "faults";
    if (!entry.key.is_bad && is_known) file.matrix.push_back(parse_matrix_key(entry, diagnostics));
    if (entry.key.is_bad || is_known ||
        !meant_key(entry.key.text, {"robot", "scene", "start_at", "start_yaw", "faults"}).empty())
      continue;
    diagnostics.add(wording::parameter_of_a_matrix(entry.key.span, entry.key.text));
    map.optional(entry.key.text);
  }
  map.finish();
}

void parse_fixed(MapReader& map, ScenarioFile& file, Diagnostics& diagnostics) {
  for (const char* name : {"robot", "scene", "start_at", "start_yaw"}) {
    const Node* node = map.optional(name);
    if (node == nullptr) continue;
    if (auto value = parse_matrix_value(name, *node, diagnostics)) {
      file.fixed.push_back({name, {std::move(*value)}, node->span});
    }
  }
  const Node* parameters = map.optional("params");
  if (parameters == nullptr || !require_mapping(*parameters, "`params`", diagnostics)) return;
  for (const Entry& entry : parameters->entries) {
    if (entry.key.is_bad) continue;
    const std::string name = "params." + entry.key.text;
    if (auto value = parse_matrix_value(name, entry.value, diagnostics)) {
      file.fixed.push_back({name, {std::move(*value)}, entry.key.span});
    }
  }
}

bool is_same(const MatrixValue& a, const MatrixValue& b) {
  return a.word.text == b.word.text && a.at == b.at && a.yaw == b.yaw;
}

/// A key beside the matrix and in it, of which one would be ignored, or a value that would run twice.
void complain_of_repetitions(const ScenarioFile& file, Diagnostics& diagnostics) {
  for (const MatrixKey& key : file.matrix) {
    const auto fixed = std::find_if(file.fixed.begin(), file.fixed.end(),
                                    [&](const MatrixKey& other) { return other.name == key.name; });
    if (fixed != file.fixed.end()) diagnostics.add(wording::duplicate_key(key.span, key.name, fixed->span));
    for (auto value = key.values.begin(); value != key.values.end(); ++value) {
      const auto first = std::find_if(key.values.begin(), value,
                                      [&](const MatrixValue& other) { return is_same(other, *value); });
      if (first != value)
        diagnostics.add(wording::duplicate_key(value->word.span, value->label, first->word.span));
    }
  }
}

void parse_fault_sets(const Node& node, ScenarioFile& file, Diagnostics& diagnostics) {
  if (!require_mapping(node, "`faults`", diagnostics)) return;
  for (const Entry& entry : node.entries) {
    if (entry.key.is_bad) continue;
    file.faults.push_back({entry.key.text, parse_faults(entry.value, true, diagnostics)});
  }
}

void parse_outcome(const Node& outcome, MapReader& map, ExpectationText& expected, Diagnostics& diagnostics) {
  expected.word = parse_word(outcome, "`outcome`", diagnostics);
  const bool is_known = std::find(outcomes.begin(), outcomes.end(), expected.word.text) != outcomes.end();
  if (expected.word.exists() && !is_known)
    diagnostics.add(wording::unknown_outcome(outcome.span, expected.word.text, outcomes));
  if (const Node* of = map.optional("of")) expected.of = parse_word(*of, "`of`", diagnostics);
}

std::optional<ExpectationText> parse_expectation(const Node& node, bool of_study, Diagnostics& diagnostics) {
  // `outcome done` means the outcome; what compares or names a part of something is a condition.
  const std::string written = node.is_scalar() ? trimmed(node.text) : "done";
  const bool is_condition =
      written.find(' ') != std::string::npos && written.find_first_of("<>.") != std::string::npos;
  MapReader map(node, "an expectation", diagnostics,
                is_condition ? "{at: end, that: " + written + "}"
                             : "{outcome: " + written.substr(written.rfind(' ') + 1) + "}");
  if (!map.is_mapping()) return std::nullopt;
  ExpectationText expected;
  expected.span = node.span;
  const int errors_before = diagnostics.error_count();
  const Node* outcome = map.optional("outcome");
  const Node* code = map.optional("diagnostic");
  const Node* at = map.optional("at");
  const Node* within = map.optional("within");
  const Node* always = map.optional("always");
  const auto given = {outcome, code, at, within, always};
  const auto count = std::count_if(given.begin(), given.end(), [](const Node* n) { return n != nullptr; });
  bool is_good = true;
  if (count != 1) {
    // An unknown key may have been the one.
    for (const char* key : {"of", "that"}) map.optional(key);
    if (count > 1 || !map.has_unread_keys()) diagnostics.add(wording::one_expectation(node.span));
    is_good = false;
  }
  if (outcome != nullptr) parse_outcome(*outcome, map, expected, diagnostics);
  if (code != nullptr) {
    expected.kind = ExpectationKind::diagnostic;
    expected.word = parse_word(*code, "`diagnostic`", diagnostics);
    if (expected.word.exists() && find_explanation(expected.word.text) == nullptr)
      diagnostics.add(wording::unknown_name(code->span, "code", expected.word.text, {}));
  }
  if (at != nullptr) {
    expected.kind = ExpectationKind::at_end;
    if (at->text != "end" && !at->is_bad) diagnostics.add(wording::at_the_end_only(at->span));
  }
  if (within != nullptr) {
    expected.kind = ExpectationKind::within;
    expected.within = parse_positive(*within, dimension::time, "`within`", true, diagnostics).value_or(0.0);
    if (const Node* of = map.optional("of")) expected.of = parse_word(*of, "`of`", diagnostics);
    const bool is_always = expected.within == 0.0 && !expected.of.exists() && !within->is_bad;
    if (is_always && within->is_scalar() && diagnostics.error_count() == errors_before)
      diagnostics.add(wording::within_no_time(within->span));
  }
  if (const Node* sure = of_study ? map.optional("probability") : nullptr)
    expected.probability = parse_certainty(*sure, "`probability`", diagnostics);
  if (const Node* sure = of_study ? map.optional("confidence") : nullptr)
    expected.confidence = parse_certainty(*sure, "`confidence`", diagnostics);
  const Node* that = always != nullptr ? always : nullptr;
  if (always != nullptr) expected.kind = ExpectationKind::always;
  // An entry with two claims does not show which claim needs `that`, so `that` is not required.
  if (at != nullptr || within != nullptr) that = is_good ? map.required("that") : map.optional("that");
  if (that != nullptr) expected.that = parse_condition(*that, diagnostics);
  map.report_split_condition();
  map.finish();
  if (!is_good) return std::nullopt;
  return expected;
}

/// One run has one outcome for each robot.
void check_outcomes(const std::vector<ExpectationText>& all, Diagnostics& diagnostics) {
  std::map<std::string, const ExpectationText*> outcome_of;
  for (const ExpectationText& one : all) {
    if (one.kind != ExpectationKind::outcome || !one.word.exists()) continue;
    const auto [first, is_new] = outcome_of.try_emplace(one.of.text, &one);
    if (!is_new && first->second->word.text != one.word.text)
      diagnostics.add(wording::two_outcomes(one.word.span, first->second->word.text, one.word.text,
                                            first->second->word.span));
  }
}

}  // namespace

std::optional<double> parse_certainty(const Node& node, const std::string& what, Diagnostics& diagnostics) {
  Node share = node;
  constexpr std::string_view at_least = ">=";
  if (share.is_scalar() && share.text.starts_with(at_least)) {
    const std::size_t begin = share.text.find_first_not_of(' ', at_least.size());
    share.text.erase(0, std::min(begin, share.text.size()));
  }
  const std::optional<double> value = parse_plain(share, dimension::none, what, diagnostics);
  if (!value) return std::nullopt;
  if (*value > 0.0 && *value < 1.0) return value;
  diagnostics.add(wording::no_certainty(node.span, what, node.text));
  return std::nullopt;
}

void parse_expectations(const Node& node, bool of_study, ScenarioFile& file, Diagnostics& diagnostics) {
  if (!require_sequence(node, "`expect`", diagnostics)) return;
  for (const Node& item : node.items) {
    if (auto expected = parse_expectation(item, of_study, diagnostics))
      file.expectations.push_back(std::move(*expected));
  }
  if (node.items.empty()) diagnostics.add(wording::nothing_expected(node.span));
  if (!of_study) check_outcomes(file.expectations, diagnostics);
}

bool parse_time_limit(MapReader& map, ScenarioFile& file, Diagnostics& diagnostics) {
  const Node* limit = map.optional("time_limit");
  if (limit == nullptr) return false;
  file.time_limit = parse_positive(*limit, dimension::time, "`time_limit`", false, diagnostics).value_or(1.0);
  return true;
}

bool parse_seed(MapReader& map, ScenarioFile& file, Diagnostics& diagnostics) {
  const Node* seed = map.optional("seed");
  if (seed == nullptr) return false;
  const auto value = parse_integer(*seed, "`seed`", 0, 1'000'000'000, diagnostics);
  file.seed = static_cast<std::uint64_t>(value.value_or(0));
  return true;
}

void parse_scenario_keys(MapReader& map, bool of_study, ScenarioFile& file, Diagnostics& diagnostics) {
  if (const Node* about = map.optional("about")) file.about = about->text;
  if (const Node* task = map.required("task")) file.task = parse_word(*task, "`task`", diagnostics);
  parse_time_limit(map, file, diagnostics);
  parse_seed(map, file, diagnostics);
  if (const Node* blend = map.optional("blend"))
    file.blend = parse_positive(*blend, dimension::time, "`blend`", true, diagnostics);
  parse_fixed(map, file, diagnostics);
  if (const Node* matrix = map.optional("matrix")) parse_matrix(*matrix, file, diagnostics);
  complain_of_repetitions(file, diagnostics);
  if (const Node* faults = map.optional("faults")) parse_fault_sets(*faults, file, diagnostics);
  if (const Node* expect = map.required("expect", "[{outcome: done}]"))
    parse_expectations(*expect, of_study, file, diagnostics);
}

std::optional<ScenarioFile> parse_scenario_file(const Document& document, Diagnostics& diagnostics) {
  MapReader map(document.root, "a scenario file", diagnostics);
  if (!map.is_mapping() || !check_version(map, "zwang_scenario", 1, diagnostics)) return std::nullopt;
  ScenarioFile file;
  parse_scenario_keys(map, false, file, diagnostics);
  map.finish();
  return file;
}

}  // namespace zwang::lang

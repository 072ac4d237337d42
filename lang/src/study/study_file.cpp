#include "study/study_file.hpp"

#include <algorithm>
#include <array>

#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_study.hpp"

namespace zwang::lang {

namespace {

namespace fs = std::filesystem;

struct SpreadWord {
  const char* word;
  Spread spread;
};
constexpr std::array spread_words{SpreadWord{"uniform", Spread::uniform},
                                  SpreadWord{"log_uniform", Spread::log_uniform},
                                  SpreadWord{"normal", Spread::normal}, SpreadWord{"choice", Spread::choice}};

DrawText parse_draw(const Entry& entry, Diagnostics& diagnostics) {
  DrawText draw;
  draw.name = {entry.key.text, entry.key.span};
  const std::string what = "the draw `" + entry.key.text + "`";
  const std::string one = entry.value.is_scalar() ? entry.value.text : "1";
  MapReader map(entry.value, what, diagnostics, "{choice: [" + one + "]}");
  if (!map.is_mapping()) return draw;
  int found = 0;
  for (const SpreadWord& word : spread_words) {
    const Node* numbers = map.optional(word.word);
    if (numbers == nullptr || ++found > 1) continue;
    if (!require_sequence(*numbers, what + "'s `" + word.word + "`", diagnostics)) continue;
    draw.spread = word.spread;
    draw.numbers = *numbers;
  }
  if (const Node* times = map.optional("times")) {
    draw.is_factor = parse_boolean(*times, "`times`", diagnostics).value_or(false);
    draw.factor_span = times->span;
  }
  if (found != 1 && !map.has_unread_keys())
    diagnostics.add(wording::one_distribution(entry.value.span, entry.key.text));
  if (found != 1) draw.spread.reset();
  map.finish();
  return draw;
}

void parse_draws(const Node& node, StudyFile& file, Diagnostics& diagnostics) {
  if (!require_mapping(node, "`draw`", diagnostics, "{params.NAME: {uniform: [1 N, 2 N]}}")) return;
  for (const Entry& entry : node.entries) {
    if (entry.key.is_bad) continue;
    if (file.draws.size() == most_draws) {
      diagnostics.add(wording::bad_draw(entry.key.span,
                                        "a study draws " + std::to_string(most_draws) + " values at most",
                                        "fix the values that matter least in the scenario"));
      return;
    }
    file.draws.push_back(parse_draw(entry, diagnostics));
  }
}

/// Two numbers of the dimension, or a list of choices.
std::optional<std::vector<double>> numbers_of(const DrawText& draw, const Dimension& dimension,
                                              const std::string& what, Diagnostics& diagnostics) {
  const bool is_choice = *draw.spread == Spread::choice;
  if (is_choice && draw.numbers.items.empty()) {
    diagnostics.add(wording::bad_distribution(draw.numbers.span, what + " has nothing to choose from",
                                              "give it a value or more"));
    return std::nullopt;
  }
  const std::size_t fewest = is_choice ? 1 : 2, most = is_choice ? most_cells : 2;
  return parse_vector(draw.numbers, dimension, fewest, most, what, diagnostics);
}

bool complain_of_order(const DrawText& draw, double first, double second, Diagnostics& diagnostics) {
  const Span& span = draw.numbers.span;
  const std::string name = "`" + draw.name.text + "`";
  if (*draw.spread == Spread::normal && !(second > 0.0)) {
    diagnostics.add(wording::bad_distribution(span, "the standard deviation of " + name + " is not above 0",
                                              "write `normal: [mean, deviation]`, or fix the value"));
    return true;
  }
  const bool is_range = *draw.spread == Spread::uniform || *draw.spread == Spread::log_uniform;
  if (is_range && first == second) {
    const std::string value = draw.numbers.items.front().text;
    diagnostics.add(wording::bad_distribution(span, "the range of " + name + " holds one value",
                                              "write `choice: [" + value + "]`, or two ends that differ"));
    return true;
  }
  if (is_range && !(first < second)) {
    diagnostics.add(wording::bad_distribution(span, "the range of " + name + " has its upper end first",
                                              "write the lower end first"));
    return true;
  }
  if (*draw.spread == Spread::log_uniform && !(first > 0.0)) {
    diagnostics.add(wording::bad_distribution(
        span, "the logarithm of 0 and of what is below does not exist: " + name + " cannot be log_uniform",
        "let the range begin above 0, or write `uniform`"));
    return true;
  }
  return false;
}

}  // namespace

std::optional<StudyFile> parse_study_file(const Document& document, Diagnostics& diagnostics) {
  MapReader map(document.root, "a study", diagnostics);
  if (!map.is_mapping() || !check_version(map, "zwang_study", 1, diagnostics)) return std::nullopt;
  StudyFile file;
  if (const Node* runs = map.required("runs", "1000")) {
    file.runs_text = {runs->text, runs->span};
    file.runs =
        static_cast<std::size_t>(parse_integer(*runs, "`runs`", 1, most_runs, diagnostics).value_or(1));
  }
  if (const Node* sequence = map.optional("sequence")) {
    const std::string word = parse_word(*sequence, "`sequence`", diagnostics).text;
    if (word == "halton") file.sequence = Sequence::halton;
    if (!word.empty() && word != "halton" && word != "random")
      diagnostics.add(wording::unknown_name(sequence->span, "sequence", word, {"random", "halton"}));
  }
  if (const Node* sure = map.optional("probability"))
    file.probability = parse_certainty(*sure, "`probability`", diagnostics);
  if (const Node* sure = map.optional("confidence"))
    file.confidence = parse_certainty(*sure, "`confidence`", diagnostics);
  if (const Node* draws = map.optional("draw")) parse_draws(*draws, file, diagnostics);
  if (const Node* scenario = map.optional("scenario")) {
    file.scenario = parse_word(*scenario, "`scenario`", diagnostics);
    if (const Node* cell = map.optional("cell")) file.cell = parse_word(*cell, "`cell`", diagnostics);
    if (const Node* about = map.optional("about")) file.own.about = about->text;
    file.has_seed = parse_seed(map, file.own, diagnostics);
    file.has_time_limit = parse_time_limit(map, file.own, diagnostics);
    if (const Node* expect = map.optional("expect")) parse_expectations(*expect, true, file.own, diagnostics);
  } else {
    parse_scenario_keys(map, true, file.own, diagnostics);
  }
  map.finish();
  return file;
}

std::optional<Distribution> distribution_of(const DrawText& draw, const Dimension& dimension,
                                            Diagnostics& diagnostics) {
  if (!draw.spread) return std::nullopt;
  Distribution distribution;
  distribution.spread = *draw.spread;
  const auto numbers = numbers_of(draw, dimension, "`" + draw.name.text + "`", diagnostics);
  if (!numbers) return std::nullopt;
  if (distribution.spread == Spread::choice) {
    distribution.values = *numbers;
    return distribution;
  }
  distribution.first = (*numbers)[0];
  distribution.second = (*numbers)[1];
  if (complain_of_order(draw, distribution.first, distribution.second, diagnostics)) return std::nullopt;
  return distribution;
}

std::optional<MatrixKey> matrix_key_of(const DrawText& draw, const fs::path& own_folder,
                                       const fs::path& folder, Diagnostics& diagnostics) {
  if (!draw.spread) return std::nullopt;
  const std::string what = "`" + draw.name.text + "`";
  if (*draw.spread != Spread::choice || draw.numbers.items.empty() || draw.is_factor) {
    diagnostics.add(wording::bad_distribution(draw.numbers.span, what + " is a name: it can only be chosen",
                                              "write `choice: [one, another]`"));
    return std::nullopt;
  }
  MatrixKey key{draw.name.text, {}, draw.name.span};
  for (const Node& item : draw.numbers.items) {
    MatrixValue value;
    value.word = parse_word(item, what, diagnostics);
    if (!value.word.exists()) return std::nullopt;
    const bool is_path = draw.name.text != "faults";
    const fs::path path = value.word.text;
    value.label = draw.name.text + " " + (is_path ? path.stem().string() : value.word.text);
    // Seen from the scenario: its reader looks there.
    if (is_path && path.is_relative() && own_folder != folder)
      value.word.text =
          fs::weakly_canonical(own_folder / path).lexically_relative(fs::weakly_canonical(folder)).string();
    key.values.push_back(std::move(value));
  }
  return key;
}

}  // namespace zwang::lang

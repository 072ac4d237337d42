/// Completion, in a text that no reader takes yet.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/file_kind.hpp"
#include "zwang/lang/names.hpp"

namespace zwang::lang {

/// Where a place stands in a YAML text, found by indents and brackets alone: the text may be wrong elsewhere.
struct TextPlace {
  std::vector<std::string> keys;  ///< from the root; `-` for an item of a list
  bool is_key = false;            ///< a key can begin here; else a value
  std::string value;              ///< of the value as far as it is written, from its begin to the place
  std::size_t word_begin = 0;     ///< [bytes] of the word that the place stands in or behind
  std::size_t value_begin = 0;    ///< [bytes] of the value, behind its opening quote
};
/// `offset`: bytes from the begin of `text`.
ZWANG_EXPORT TextPlace place_at(std::string_view text, std::size_t offset);

enum class ProposalKind { key, word, unit, name, function, file };

struct Proposal {
  std::string text;  ///< stands in the place of the word
  ProposalKind kind = ProposalKind::key;
  std::string about;      ///< a few words; may be empty
  bool is_whole = false;  ///< stands in the place of the whole value: `std_msgs/Bool`, a file, `frames.wall`
};

struct KnownFile {
  std::string name;              ///< as the text names it, from its own folder
  std::optional<FileKind> kind;  ///< none: a URDF
};

/// The names that a completion knows beside the text.
struct KnownNames {
  std::vector<NamePlace> given;     ///< by the last text that could be read
  std::vector<std::string> frames;  ///< of the robot, and `world`
  /// The files around, the nearest ones first. It is called where a file can be named: it reads folders.
  std::function<std::vector<KnownFile>()> files;
};

/// Keys by the schema, words, names and units that fit, in this order. `offset`: bytes from the begin.
ZWANG_EXPORT std::vector<Proposal> proposals(FileKind kind, std::string_view text, std::size_t offset,
                                             const KnownNames& known);

/// Whether no key is written yet: comments alone, and at most the begin of one word.
ZWANG_EXPORT bool begins_a_file(std::string_view text);

/// The schema's description of a key or of its value; may be empty.
ZWANG_EXPORT std::string about_key(FileKind kind, const std::vector<std::string>& keys);

/// In SI, as `0.08 m/s`, what a quantity is; empty where the text is no quantity with a unit or is in SI
/// already.
ZWANG_EXPORT std::string in_si(std::string_view text);
/// `a velocity`; empty where the text is no quantity with a unit.
ZWANG_EXPORT std::string kind_of_quantity(std::string_view text);

}  // namespace zwang::lang

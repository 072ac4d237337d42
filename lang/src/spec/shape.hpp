/// Reading mappings whose keys are known: what is missing, unknown or of the wrong shape is reported once.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "spec/value.hpp"
#include "tree/node.hpp"
#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang {

/// Asks a mapping for its keys by name; `finish` reports what was not asked for and what was missed.
class MapReader {
 public:
  /// `what` names the mapping in messages: "task `press`". Not a mapping: E104, as of `require_mapping`.
  MapReader(const Node& node, std::string what, Diagnostics& diagnostics, const std::string& example = {});

  bool is_mapping() const { return node_.is_mapping() && !node_.is_bad; }
  const Node* optional(std::string_view key);
  /// `value` is what the help of the missing key proposes.
  const Node* required(std::string_view key, const std::string& value = "..");
  const Node& node() const { return node_; }
  const std::string& what() const { return what_; }
  /// Marks every key as known: their names are the author's.
  void allow_others() { others_allowed_ = true; }
  /// Keys that a comma inside a flow-style value split off: `{when: a, b < 1, ..}`. Reported as E107.
  bool report_split_condition();
  /// Whether an unknown key looks like one of these: then their absence has its cause already.
  bool has_misspelt(const std::vector<std::string>& keys) const;
  /// Keys that are unknown or were complained of.
  bool has_unread_keys() const;
  void finish();

 private:
  bool is_unknown(const Entry& entry) const;
  bool report_decimal_comma_before(const Entry& entry);
  void report_unknown_keys();
  std::string text_cut_before(const Entry& entry) const;
  /// How an unknown key's matter is said here; empty: it may be a misspelt key.
  std::string remedy_of(const Entry& entry) const;
  bool is_axis_in_one_word(const Entry& entry) const;
  std::string axes_in_one_word() const;
  std::string range_of_bound(const Entry& entry) const;
  std::string whole_of_parts(const std::string& meant) const;

  const Node& node_;
  std::string what_;
  Diagnostics& diagnostics_;
  std::vector<std::string> known_;
  std::vector<std::string> missing_;
  std::map<std::string, std::string> proposals_;  ///< of missing keys: their values in the help
  bool others_allowed_ = false;
  bool split_reported_ = false;
};

/// A name: one word of letters, digits and underscores.
Word parse_name(const Node& node, const std::string& what, Diagnostics& diagnostics);
/// Any text on one place: a frame, a joint, a path.
Word parse_word(const Node& node, const std::string& what, Diagnostics& diagnostics);
/// A sentence for people: `about`, `help`, `note`.
std::string parse_text(const Node& node, const std::string& what, Diagnostics& diagnostics);
/// A whole number in [low, high].
std::optional<int> parse_integer(const Node& node, const std::string& what, int low, int high,
                                 Diagnostics& diagnostics);
std::optional<bool> parse_boolean(const Node& node, const std::string& what, Diagnostics& diagnostics);
/// Whether the node is a sequence; E104 otherwise.
bool require_sequence(const Node& node, const std::string& what, Diagnostics& diagnostics);
/// `example` is what may be written in the place of a single value: `{friction: 0.9}`; empty: nobody knows.
bool require_mapping(const Node& node, const std::string& what, Diagnostics& diagnostics,
                     const std::string& example = {});
/// `[0, 0]` for `[0 m, 0 m]`: who forgets the unit forgets it everywhere, and is told once. Whether it was
/// so.
bool complain_of_bare_numbers(const Node& list, const Dimension& expected, const std::string& what,
                              Diagnostics& diagnostics);
/// `[3 m, 0 m, 20 deg]` where a place is due, or a height of what stands on the floor. The keys of a place
/// and of a heading are those of the mapping; `yaw_key` empty: there is none. Whether it was so.
bool complain_of_third_value(const Node& place, const std::string& what, const std::string& place_key,
                             const std::string& yaw_key, bool may_have_height, Diagnostics& diagnostics);
/// A place on the floor, [m].
std::optional<std::array<double, 2>> parse_place(const Node& node, const std::string& what,
                                                 const std::string& yaw_key, Diagnostics& diagnostics);
/// The corners of `what`, [m]; nullopt when one is bad.
std::optional<std::vector<std::array<double, 2>>> parse_polygon(const Node& node, const std::string& what,
                                                                Diagnostics& diagnostics);
/// A list of places under any key, [m]; nullopt when one is bad. `part` names one of them: "a corner of
/// region `hall`".
std::optional<std::vector<std::array<double, 2>>> parse_places(const Node& node, const std::string& list,
                                                               const std::string& part,
                                                               Diagnostics& diagnostics);
/// Plain quantities of one dimension: `[0.4 m, 0 m]`. nullopt when one is bad.
std::optional<std::vector<double>> parse_vector(const Node& node, const Dimension& expected,
                                                std::size_t fewest, std::size_t most, const std::string& what,
                                                Diagnostics& diagnostics);
/// One plain quantity of a dimension, SI.
std::optional<double> parse_plain(const Node& node, const Dimension& expected, const std::string& what,
                                  Diagnostics& diagnostics);
/// One plain quantity above zero, or, with `zero_allowed`, not below zero. E105 otherwise.
std::optional<double> parse_positive(const Node& node, const Dimension& expected, const std::string& what,
                                     bool zero_allowed, Diagnostics& diagnostics);
/// E105 for a value that was read before and is not above zero (with `zero_allowed`: below zero).
bool require_positive(const ValueText& value, const Dimension& expected, const std::string& what,
                      bool zero_allowed, Diagnostics& diagnostics);
/// Checks `zwang: 1` and its kin; false when the file is in a version that is not read here, 1 to `newest`.
bool check_version(MapReader& map, const std::string& key, int newest, Diagnostics& diagnostics);

constexpr int newest_task_version = 2;

}  // namespace zwang::lang

/// Diagnostics of things that are written in another program's way: a list for a mapping, a mapping for a
/// range, a heading in a place.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang::wording {

/// A number, where a mapping is due, in the words of an example: `{friction: 0.9}`.
Diagnostic mapping_by_example(const Span& span, const std::string& what, const std::string& example);
/// An unknown key whose matter is said in another way.
Diagnostic said_otherwise(const Span& span, const std::string& key, const std::string& what,
                          const std::string& remedy);
/// Other than a list, and the list that was meant.
Diagnostic vector_by_example(const Span& span, const std::string& what, const std::string& list);
/// `left: {..}` in the place of `- {..}`.
Diagnostic named_items(const Span& span, const std::string& what, const std::string& name);
/// Of a template's `args`.
/// A template is a task or a group.
Diagnostic body_and_group(const Span& span, const std::string& name);
/// `is_group`: the template's, used for a task; else the other way around.
Diagnostic template_of_another_part(const Span& span, const std::string& name, bool is_group);
Diagnostic argument_without_kind(const Span& span, const std::string& name);
/// Of a frame that is nowhere declared, and that a `set` names.
Diagnostic frame_only_set(const Span& span, const std::string& name);
/// `FILL_IN` of a drafted robot file: at `span`, and wherever it stands beside.
Diagnostic still_to_fill_in(const Span& span, const std::vector<Span>& others);
/// A condition asks whether the robot touches something.
Diagnostic contact_in_a_condition(const Span& span, const std::string& name);
/// `true`, `go.done`, `timeout` in a condition; nullopt: a word of no other language.
std::optional<Diagnostic> word_for_a_condition(const Span& span, const std::string& written);
/// `26:1`; `turns` are those of the motor for one of the joint.
Diagnostic gear_as_a_ratio(const Span& span, const std::string& turns);
/// A region where its name is due; `region` is empty, or how it is declared.
Diagnostic region_without_name(const Span& span, const std::string& region);
/// `- name: wall` for `wall:`.
Diagnostic name_in_an_item(const Span& span, const std::string& what, const std::string& key,
                           const std::string& name);
/// `footprint: [[0.4 m, 0.3 m], ..]`.
Diagnostic footprint_without_polygon(const Span& span);
/// A third number in a place; it stands beside as `yaw`.
Diagnostic heading_in_a_place(const Span& span, const std::string& what, const std::string& place,
                              const std::string& yaw);
/// `[3 m, 0 m, 0 m]` where a place on the floor is due.
Diagnostic height_in_a_place(const Span& span, const std::string& what, const std::string& place);
/// `start_at: [0 m, 0 m]` in a matrix, where each of a list is such a place.
Diagnostic place_for_a_list(const Span& span, const std::string& what);
/// `{min: -1 N, max: 1 N}` for a range; an end that is not given is empty.
Diagnostic range_by_names(const Span& span, const std::string& low, const std::string& high);
/// `speed: {velocity: 0.3 m/s}` for `[0 m/s, 0.3 m/s]`.
Diagnostic speed_without_range(const Span& span, const std::string& what, const std::string& most);
/// `1 m, 2 m` for `[1 m, 2 m]`.
Diagnostic range_without_brackets(const Span& span, const std::string& text);
/// `[0, 2 m]`: an end without its unit, or `0.2 m` with a decimal comma.
Diagnostic end_without_unit(const Span& span, const std::string& what, const std::string& with_unit,
                            const std::string& with_point);
/// `params.push` for `push`, behind a `$`.
Diagnostic unknown_parameter(const Span& span, const std::string& name,
                             const std::vector<std::string>& known);
/// `success` for `done`.
Diagnostic unknown_target(const Span& span, const std::string& name, const std::vector<std::string>& known);
/// `base` is the URDF's root.
Diagnostic unknown_base(const Span& span, const std::string& name, const std::vector<std::string>& links,
                        const std::string& root);
/// The name of a link where a joint belongs; `joint` is the one above it.
Diagnostic link_for_a_joint(const Span& span, const std::string& link, const std::string& joint);
/// `base` is the link of the robot that floats; empty: there is no robot.
Diagnostic unknown_frame(const Span& span, const std::string& kind, const std::string& name,
                         const std::vector<std::string>& known, const std::string& base);

/// For `100 Hz` where a time is due, and for `10 ms` where a frequency is: 1/value in its unit.
std::string help_to_invert(double inverse, bool is_time);

}  // namespace zwang::lang::wording

/// Diagnostics of slips that have a literal fix: letters of a word processor, words in capitals, the wrong
/// kind of file.
#pragma once

#include <string>
#include <vector>

#include "words/dimension.hpp"
#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang::wording {

/// The quantity with its superscripts, dots, signs and commas as zwang writes them: `0,1 m/s²` is
/// `0.1 m/s^2`. The text itself where nothing is to be done.
std::string plainly_written(const std::string& text);
/// Offers that spelling; `plain` reads well.
Diagnostic odd_letters(const Span& span, const std::string& text, const std::string& plain);
/// `{at: end, elapsed > 2 s}` for `{at: end, that: elapsed > 2 s}`.
Diagnostic condition_without_key(const Span& span, const std::string& what, const std::string& key,
                                 const std::string& condition);
/// The driver of an axis is no quantity. `meant` is the name of a signal that the author may have meant, or
/// empty.
Diagnostic unknown_driver(const Span& span, const std::string& name, const std::string& meant,
                          bool is_position);
/// `$here` for `here`.
Diagnostic dollar_before_here(const Span& span);
/// `push` for `params.push` in a matrix.
Diagnostic parameter_of_a_matrix(const Span& span, const std::string& key);
/// A hook is a frame of the robot's own.
Diagnostic unknown_hook(const Span& span, const std::string& name, const std::string& meant);
/// `reach.position` for `reach`.
Diagnostic quantity_of_a_feature(const Span& span, const std::string& written, const std::string& feature);
/// `timeout: {after: never}`.
Diagnostic never_after(const Span& span);
/// `2*$press`.
Diagnostic computed_value(const Span& span, const std::string& text);
/// Several numbers without a unit, and how the whole is written with them.
Diagnostic needs_units(const Span& span, const std::string& what, const std::string& written);
Diagnostic argument_without_unit(const Span& span, const std::string& argument, const std::string& number,
                                 const Dimension& expected);
/// `contact.x` for `contact.x.position`.
Diagnostic axis_without_quantity(const Span& span, const std::string& axis);
/// `tool.x`, or `tool`.
Diagnostic frame_for_a_quantity(const Span& span, const std::string& written, const std::string& frame);
/// `AND` for `and`.
Diagnostic word_in_capitals(const Span& span, const std::string& text, const std::string& word);
Diagnostic divides_by_zero(const Span& span);
/// A range of speeds begins at 0.
Diagnostic speed_from_zero(const Span& span, const std::string& what);
/// Of `plane`.
Diagnostic norm_from_zero(const Span& span, const std::string& what);
Diagnostic norm_that_drives(const Span& span, const std::string& what);
/// `push` for `$push`.
Diagnostic parameter_without_dollar(const Span& span, const std::string& name);
Diagnostic silent_axis(const Span& span, const std::string& axis);
/// `{free}` for `free`.
Diagnostic free_in_brackets(const Span& span);
/// `0,08 m/s` in brackets, where a comma ends an item.
Diagnostic decimal_comma(const Span& span, const std::string& number);
/// `near.x.velocity` for `near.velocity`.
Diagnostic axis_of_a_feature(const Span& span, const std::string& group, const std::string& quantity);
/// Of a region (E410) or a footprint (E807).
Diagnostic crossing_edges(const char* code, const Span& span, const std::string& what);
Diagnostic unknown_signal_type(const Span& span, const std::string& text, const std::string& meant);
Diagnostic bare_attempts(const Span& span, const std::string& text);
Diagnostic footprint_is_no_frame(const Span& span);
/// A name in an expectation that is none of the plant's.
Diagnostic unknown_truth(const Span& span, const std::string& name, const std::string& meant);
/// `not` as the name of a signal.
Diagnostic word_for_a_name(const Span& span, const std::string& word);
/// The scene measures something else for it than the task file takes it for.
Diagnostic signal_of_another_type(const Span& span, const std::string& name, const std::string& measured,
                                  const std::string& expected, const std::string& remedy,
                                  const Span& declared);
/// It is older than `stale_after` before the next sample comes. [s]
Diagnostic signal_too_old(const Span& span, const std::string& name, double delay, double period, double age,
                          const Span& stale_after);
/// `partner` [an object] holds the hook in its dock, and can be pushed.
Diagnostic partner_rolls(const Span& span, const std::string& hook, const std::string& partner,
                         const Span& object);
/// Of the scene, and the task file has none of this name.
Diagnostic unheard_signal(const Span& span, const std::string& name, const std::string& meant);
/// The use of a signal that the scene does not give.
enum class UnfedUse { condition, motion, wrench };
Diagnostic unfed_signal(const Span& span, const std::string& name, UnfedUse use, const Span& declared);
/// A pose signal's name where a frame belongs.
Diagnostic signal_is_no_frame(const Span& span, const std::string& name);
/// `level: 0` outside of `always`.
Diagnostic level_of_always(const Span& span, const std::string& what);
/// The margin eats the region up. `footprint`: of what has to be inside, the widest circle's radius. [m]
Diagnostic no_inside(const Span& span, const std::string& region, double margin, double footprint,
                     const Span& declared);
/// A line that begins with `%`.
Diagnostic directive(const Span& span);
Diagnostic urdf_for_robot_file(const Span& span);

/// `written` with the unit that quantities of `expected` usually have, where it lacks one: `20` as `20 deg`.
std::string with_unit(const std::string& written, const Dimension& expected);
/// Lines of a group, from `key` on, that stand in the column of the groups' names. `group` is the name above
/// them. Empty: there is none.
Diagnostic not_indented(const Span& span, const std::string& key, const std::string& group);
/// Lines of a task, from `key` on, that stand in the column of the tasks' names. `task` is the name above
/// them.
Diagnostic not_indented_in_task(const Span& span, const std::string& key, const std::string& task);
/// The lines of a group in a task, without `constraints`.
Diagnostic group_in_a_task(const Span& span, const std::string& key);
/// `position 1 m`, `velocity:0.1 m/s`, `rz:{velocity`: the key that is in it is `key`.
Diagnostic no_colon_or_space(const Span& span, const std::string& written, const std::string& key);
/// `written` is `${push}`.
Diagnostic parameter_in_braces(const Span& span, const std::string& written);
/// `found`: what `name` is instead.
Diagnostic argument_of_another_kind(const Span& span, const std::string& argument, const std::string& kind,
                                    const std::string& name, const std::string& found);
/// A frame whose parent has its own name, which is a signal's, too.
Diagnostic frame_hides_signal(const Span& span, const std::string& name, const Span& signal);
/// A number signal as the place: mostly a distance that a sensor on the robot measures.
Diagnostic measured_position_in_own_axes(const Span& span, const std::string& axis,
                                         const std::string& signal);
/// `key`: of the text, such as `note`.
Diagnostic split_text(const Span& span, const std::string& key);

/// A `\r` that no `\n` follows.
Diagnostic lone_return(const Span& span);

}  // namespace zwang::lang::wording

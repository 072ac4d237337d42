/// Every wording of the front end, one function each: what is wrong, and what to write instead.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "words/dimension.hpp"
#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang {
struct Parameter;
}

namespace zwang::lang::wording {

// --- Text and shape: E100 to E117 (wordings_text.cpp) ---
Diagnostic unreadable_file(const Span& span, const std::string& path, const std::string& reason);
Diagnostic not_a_path(const Span& span, const std::string& written);
Diagnostic path_outside_root(const Span& span, const std::string& written);
Diagnostic file_too_large(const Span& span, const std::string& code, std::size_t limit);
Diagnostic not_utf8(const Span& span, const std::string& code);
Diagnostic forbidden_character(const Span& span, const std::string& code, char32_t character);
Diagnostic line_too_long(const Span& span, std::size_t limit);
Diagnostic open_quote(const Span& span);
Diagnostic tab(const Span& span, bool indents);
Diagnostic unreadable_yaml(const Span& span, const std::string& reason);
Diagnostic empty_file(const Span& span);
Diagnostic second_document(const Span& span);
Diagnostic block_scalar(const Span& span);
Diagnostic complex_key(const Span& span);
Diagnostic alias(const Span& span);
Diagnostic anchor(const Span& span);
Diagnostic exclamation_for_not(const Span& span);
Diagnostic tag(const Span& span);
Diagnostic merge_key(const Span& span);
Diagnostic duplicate_key(const Span& span, const std::string& key, const Span& first);
Diagnostic too_deep(const Span& span, int limit);
Diagnostic too_many_nodes(const Span& span, int limit);
Diagnostic too_many_expanded_nodes(const Span& span, int limit);
Diagnostic key_too_long(const Span& span, std::size_t limit);
Diagnostic scalar_too_long(const Span& span, std::size_t limit);
Diagnostic too_many_tasks(const Span& span, std::size_t limit);
Diagnostic too_many_groups(const Span& span, std::size_t limit);
Diagnostic other_version(const Span& span, const std::string& key, const std::string& version, int newest);
Diagnostic missing_version(const Span& span, const std::string& what, const std::string& key);
/// `what` is wanted, and the file begins with the key of another kind of file.
Diagnostic another_kind_of_file(const Span& span, const std::string& what, const std::string& key);
/// `missing` are keys that would have to be there: one of them may be what was meant.
Diagnostic unknown_key(const Span& span, const std::string& key, const std::string& what,
                       const std::string& meant, const std::vector<std::string>& known,
                       const std::vector<std::string>& missing);
Diagnostic missing_key(const Span& span, const std::string& what, const std::string& key,
                       const std::string& value = "..");
Diagnostic expected_mapping(const Span& span, const std::string& what, bool is_list);
/// `unit` is what an author would write behind each of the numbers.
Diagnostic expected_vector(const Span& span, const std::string& what, std::size_t count,
                           const std::string& unit);
Diagnostic expected_list(const Span& span, const std::string& what);
/// `word`: what stands in it; empty: nothing that may be one.
Diagnostic expected_word(const Span& span, const std::string& what, const std::string& word);
Diagnostic expected_value(const Span& span, const std::string& what, bool is_empty);
Diagnostic expected_integer(const Span& span, const std::string& what, int low, int high, int meant);
Diagnostic expected_boolean(const Span& span, const std::string& what);
Diagnostic expected_condition(const Span& span);
Diagnostic not_a_name(const Span& span, const std::string& text);
Diagnostic reserved_name(const Span& span, const std::string& name);
Diagnostic wrong_count(const Span& span, const std::string& what, std::size_t fewest, std::size_t most,
                       std::size_t found);
Diagnostic range_ends(const Span& span, std::size_t found);
Diagnostic range_where_value(const Span& span, const std::string& what, const std::string& value);
Diagnostic value_where_range(const Span& span, const std::string& what, const std::string& text);
/// `instead` says it as a statement.
Diagnostic bare_axis(const Span& span, const std::string& axis, const std::string& text,
                     const std::string& instead);
Diagnostic bare_timeout(const Span& span, const std::string& text);
Diagnostic bad_set(const Span& span, const std::string& key);
Diagnostic yaw_and_rpy(const Span& span, const std::string& what, const Span& yaw);
Diagnostic no_tasks(const Span& span);
Diagnostic not_a_value(const Span& span, const std::string& text);
Diagnostic only_a_quantity(const Span& span, const std::string& what, const Dimension& expected);
Diagnostic number_out_of_range(const Span& span, const std::string& text);
Diagnostic split_condition(const Span& span);

// --- Comments that speak to zwang: E118 to W120 (wordings_text.cpp) ---
Diagnostic unreadable_instruction(const Span& span, const std::string& word);
Diagnostic allowance_without_code(const Span& span);
Diagnostic allowance_without_reason(const Span& span, const std::string& code);
Diagnostic unknown_code(const Span& span, const std::string& code, const std::string& meant);
Diagnostic allowed_error(const Span& span, const std::string& code);
Diagnostic idle_allowance(const Span& span, const std::string& code, int line);

// --- Conditions: E105 (wordings_conditions.cpp) ---
Diagnostic condition_ends(const Span& span);
Diagnostic condition_too_deep(const Span& span, int limit);
Diagnostic missing_parenthesis(const Span& opened);
Diagnostic unopened_parenthesis(const Span& span);
Diagnostic symbol_for_word(const Span& span, const std::string& symbol, const std::string& word);
Diagnostic equality(const Span& span);
Diagnostic equality_of_truth(const Span& span);
Diagnostic chained_comparison(const Span& span);
Diagnostic unexpected_in_condition(const Span& span, const std::string& text);
Diagnostic missing_argument(const Span& span, const std::string& function);

// --- Quantities: E201 to E205 (wordings_meaning.cpp) ---
Diagnostic needs_unit(const Span& span, const std::string& what, const std::string& number,
                      const Dimension& expected);
Diagnostic wrong_dimension(const Span& span, const std::string& what, const Dimension& expected,
                           const Dimension& found);
Diagnostic wrong_parameter_dimension(const Span& span, const std::string& what, const Dimension& expected,
                                     const std::string& parameter, const Dimension& found,
                                     const Span& declared);
Diagnostic unlike_operands(const Span& span, const std::string& op, const Dimension& left,
                           const Dimension& right);
Diagnostic unknown_unit(const Span& span, const std::string& text, const std::string& unknown,
                        const std::string& meant);
Diagnostic outside_range(const Span& span, const Parameter& parameter, double value);
Diagnostic parameter_needs_quantity(const Span& span, const std::string& name);
Diagnostic not_a_condition(const Span& span, const Dimension& found);
Diagnostic expected_number(const Span& span);
Diagnostic misplaced_here(const Span& span, const std::string& what);

// --- Names: E301 to E305 (wordings_meaning.cpp) ---
/// `known`: the names that would do; the nearest is offered, else they are listed.
Diagnostic unknown_name(const Span& span, const std::string& kind, const std::string& name,
                        const std::vector<std::string>& known);
Diagnostic unknown_function(const Span& span, const std::string& name, const std::string& meant,
                            const std::vector<std::string>& known);
Diagnostic unknown_quantity(const Span& span, const std::string& name, const std::string& meant);
Diagnostic unknown_axis(const Span& span, const std::string& group, const std::string& axis, bool is_axis,
                        const std::vector<std::string>& known);
Diagnostic unused(const Span& span, const std::string& kind, const std::string& name);
Diagnostic frame_loop(const Span& span, const std::vector<std::string>& names);
Diagnostic name_taken(const Span& span, const std::string& name, const std::string& owner);
Diagnostic not_settable(const Span& span, const std::string& name);

Diagnostic template_recursion(const Span& span, const std::string& name);
Diagnostic extra_argument(const Span& span, const std::string& name, const std::string& argument,
                          const std::string& meant);
Diagnostic missing_template_arguments(const Span& span, const std::string& name,
                                      const std::vector<std::string>& arguments);
Diagnostic wrong_argument(const Span& span, const std::string& argument, const std::string& expected);
Diagnostic not_a_number_signal(const Span& span, const std::string& name, const Span& declared);
Diagnostic not_a_pose_signal(const Span& span, const std::string& name, const Span& declared);
Diagnostic incomparable_signal(const Span& span, const std::string& name, bool is_pose);
/// Of a group with `inside`, which moves `move`.
Diagnostic boundary_in_a_condition(const Span& span, const std::string& group, const std::string& move);
Diagnostic unit_without_number(const Span& span, const std::string& name);

// --- Regions and features: E104, E410 to E412 (wordings_meaning.cpp) ---
Diagnostic one_region_shape(const Span& span, const std::string& what);
Diagnostic flat_region(const Span& span, const std::string& what);
Diagnostic one_feature_kind(const Span& span, const std::string& what);
Diagnostic not_an_axis_of_a_frame(const Span& span, const std::string& text);
Diagnostic feature_without_direction(const Span& span, const std::string& what);
Diagnostic rigid_feature(const Span& span, const std::string& name);

// --- Constraints: E401 to E409 (wordings_meaning.cpp) ---
Diagnostic driven_twice(const Span& span, const std::string& axis, const std::string& first,
                        const std::string& second, const Span& first_span);
Diagnostic empty_range(const Span& span, const std::string& low, const std::string& high);
Diagnostic position_in_own_axes(const Span& span, const std::string& axis, const std::string& in,
                                const std::string& move);
Diagnostic force_range_without_zero(const Span& span, const std::string& axis);
Diagnostic beyond_always(const Span& span, const std::string& axis, const std::string& asked,
                         const std::string& limiting, const std::string& allowed, const Span& limit);
/// `missing`: the first of the keys that the axis does not have.
Diagnostic incomplete_spring(const Span& span, const std::string& axis, const std::string& missing);
Diagnostic spring_with_time_constant(const Span& span, const std::string& axis);
Diagnostic immovable(const Span& span, const std::string& frame);
/// `function` asks how a frame moves that nothing moves; `base` is a name to ask about instead.
Diagnostic motionless(const Span& span, const std::string& function, const std::string& frame,
                      const std::string& base);
/// A place on a feature that it never comes to.
Diagnostic beyond_a_distance(const Span& span, const std::string& axis);
Diagnostic beyond_an_angle(const Span& span, const std::string& axis);
Diagnostic group_without_axes(const Span& span, const std::string& group);

// --- Order: W501 to E508 (wordings_meaning.cpp) ---
Diagnostic measured_without_for(const Span& span);
Diagnostic unreachable_task(const Span& span, const std::string& task);
Diagnostic endless_task(const Span& span, const std::string& task);
Diagnostic signal_without_age(const Span& span, const std::string& name);
Diagnostic latch_is_not_bool(const Span& span, const std::string& signal, const std::string& type);
Diagnostic latch_off_the_base(const Span& span, const std::string& frame, const std::string& base);
/// `by_half_turn`: because an angle starts anew at 180 deg.
Diagnostic decided_condition(const Span& span, bool is_always, bool by_half_turn);
Diagnostic release_without_threshold(const Span& span);
Diagnostic release_on_wrong_side(const Span& span, bool is_below);
Diagnostic hidden_exit(const Span& span, const Span& first, bool is_same);
Diagnostic back_without_interruption(const Span& span, bool under_always);

// --- Robot files and URDFs: E801 to E860; scenes: E901 (wordings_robot.cpp) ---
Diagnostic not_positive(const Span& span, const std::string& what, bool zero_allowed);
Diagnostic fixed_joint(const Span& span, const std::string& joint, const Span& declared);
/// Of a joint or a link that the robot file uses, and that hangs on a `link` of its `ignore`.
Diagnostic ignored_part(const Span& span, const std::string& part, const std::string& link,
                        const Span& ignored);
Diagnostic sliding_wheel(const Span& span, const std::string& joint, const Span& declared);
Diagnostic doubled_wheel(const Span& span, const std::string& joint);
Diagnostic no_wheels(const Span& span);
Diagnostic roller_angle(const Span& span, const std::string& what);
Diagnostic holds_and_roller(const Span& span, const std::string& what);
Diagnostic unknown_direction(const Span& span, const std::string& text);
Diagnostic base_below_joint(const Span& span, const std::string& base, const std::string& joint);
Diagnostic no_effort(const Span& span, const std::string& joint, const Span& declared);
Diagnostic compensation_too_large(const Span& span, const std::string& what);
Diagnostic limit_without_rest(const Span& span, const std::string& what);
Diagnostic too_few_corners(const Span& span, const std::string& what);
Diagnostic flat_polygon(const Span& span, const std::string& what);
Diagnostic posture_outside(const Span& span, const std::string& what, const Span& joint);
Diagnostic impossible_model(const Span& span, const std::string& reason);
Diagnostic control_period_outside(const Span& span, double period);
/// `step` [rad] of the encoders.
Diagnostic encoder_step_outside(const Span& span, double step);
/// `radius` [m] of the largest wheel.
Diagnostic coarse_encoders(const Span& span, double step, double radius);
Diagnostic estimate_without_torque(const Span& span, const std::string& name);
Diagnostic unknown_drive_word(const Span& span, const std::string& key, const std::string& text,
                              const std::vector<std::string>& known);
Diagnostic limit_beside_twist(const Span& span);
Diagnostic twist_of_swivels(const Span& span, const std::string& joint, const Span& drive);
Diagnostic drive_without_wheel(const Span& span, const std::string& joint, const Span& drive);
Diagnostic drive_key_beside_torque(const Span& span, const std::string& key);
Diagnostic drive_too_slow(const Span& span, double rate);   ///< [1/s]
Diagnostic drive_too_late(const Span& span, double delay);  ///< [s]

Diagnostic xml_too_deep(const Span& span, int limit);
Diagnostic too_many_attributes(const Span& span, std::size_t limit);
Diagnostic too_many_links(const Span& span, std::size_t limit);
Diagnostic not_xml(const Span& span, const std::string& reason);
Diagnostic not_urdf(const Span& span, const std::string& root);
Diagnostic unexpanded_macro(const Span& span, const std::string& text);
Diagnostic bad_urdf_number(const Span& span, const std::string& attribute, const std::string& text,
                           std::size_t count);
Diagnostic unnamed_element(const Span& span, const std::string& element);
Diagnostic doubled_in_urdf(const Span& span, const std::string& kind, const std::string& name);
Diagnostic no_links(const Span& span);
Diagnostic joint_without_link(const Span& span, const std::string& joint, const std::string& role);
Diagnostic missing_link(const Span& span, const std::string& joint, const std::string& link);
Diagnostic two_parents(const Span& span, const std::string& link);
Diagnostic no_root(const Span& span);
Diagnostic two_roots(const Span& span, const std::string& first, const std::string& second);
Diagnostic unreached_link(const Span& span, const std::string& link, const std::string& root);
Diagnostic incomplete_inertial(const Span& span, const std::string& link, const std::string& missing);
Diagnostic impossible_mass(const Span& span, const std::string& link, double mass);
Diagnostic impossible_inertia(const Span& span, const std::string& link);
/// Of a link that is fixed to another: its `mass` [kg], and which share of the robot's that is.
Diagnostic negligible_inertia(const Span& span, const std::string& link, double mass, double share);
/// `share` of its largest moment by which each was moved.
Diagnostic corrected_inertia(const Span& span, const std::string& link, double share);
Diagnostic joint_type(const Span& span, const std::string& joint, const std::string& type);
Diagnostic zero_axis(const Span& span, const std::string& joint);
Diagnostic joint_without_limit(const Span& span, const std::string& joint, const std::string& type);
Diagnostic unordered_limits(const Span& span, const std::string& joint, double lower, double upper,
                            bool slides);
Diagnostic negative_limit(const Span& span, const std::string& joint);
Diagnostic urdf_refused(const Span& span, const std::string& message);

Diagnostic one_shape(const Span& span, const std::string& what);
Diagnostic fixed_with_mass(const Span& span, const std::string& what, const Span& mass);
Diagnostic scripted_with_mass(const Span& span, const std::string& what, const Span& mass);
Diagnostic one_fault(const Span& span);
Diagnostic fault_of_all(const Span& span);
Diagnostic leaves_for_good(const Span& span);
Diagnostic unknown_fault(const Span& span, const std::string& key, const std::string& text,
                         const std::vector<std::string>& known);
/// Of a motor that is none: nothing would go wrong.
Diagnostic fault_without_motor(const Span& span, const std::string& joint);
Diagnostic too_light(const Span& span, double most);
Diagnostic too_nimble(const Span& span);
Diagnostic script_step(const Span& span);
Diagnostic mixed_script(const Span& span, const std::string& what, bool starts_with_number,
                        const Span& first);
Diagnostic empty_script(const Span& span, const std::string& what);
Diagnostic empty_motion(const Span& span, const std::string& what);
Diagnostic times_not_rising(const Span& span, const std::string& what);
Diagnostic one_signal_source(const Span& span, const std::string& signal);
Diagnostic all_dropped(const Span& span);
Diagnostic nothing_latches(const Span& span, const std::string& name);
Diagnostic not_felt(const Span& span, const std::string& name);
Diagnostic delayed_too_long(const Span& span, const std::string& what, double most);
Diagnostic fix_of_measured(const Span& span, const std::string& key, const Span& measured);
Diagnostic too_many_robots(const Span& span, std::size_t most);
Diagnostic no_rollers(const Span& span, const std::string& robot);

Diagnostic unknown_outcome(const Span& span, const std::string& text, const std::vector<std::string>& known);
Diagnostic one_expectation(const Span& span);
Diagnostic at_the_end_only(const Span& span);
/// Of one robot.
Diagnostic two_outcomes(const Span& span, const std::string& first, const std::string& second,
                        const Span& first_span);
Diagnostic within_no_time(const Span& span);
Diagnostic nothing_expected(const Span& span);
Diagnostic empty_matrix_key(const Span& span, const std::string& key);
Diagnostic too_many_cells(const Span& span, std::size_t most);
Diagnostic not_a_time(const Span& span, const std::string& name);

}  // namespace zwang::lang::wording

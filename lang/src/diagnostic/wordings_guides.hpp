/// Diagnostics of objects on hinges, slides and casters, of leaning objects, and of hands.
#pragma once

#include <string>

#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang::wording {

/// `key` and `other` are keys of the object, each of which says how it moves.
Diagnostic two_ways_to_move(const Span& span, const std::string& what, const std::string& key,
                            const std::string& other);
Diagnostic moves_without_mass(const Span& span, const std::string& what, const std::string& key);
/// Of a hinge or a slide whose range does not hold 0, or has no width.
Diagnostic range_without_start(const Span& span, const std::string& what, bool turns);
Diagnostic preload_to_both_sides(const Span& span, const std::string& what);
Diagnostic yaw_twice(const Span& span, const std::string& what);
/// `key` says that the object moves, is round or holds a hook.
Diagnostic leans_and(const Span& span, const std::string& what, const std::string& key);
/// Of a hand: `reason` tells why the object does not move.
Diagnostic push_without_effect(const Span& span, const std::string& object, const std::string& reason);
Diagnostic push_off_the_floor(const Span& span, const std::string& object);
Diagnostic push_of_two(const Span& span);
Diagnostic push_without_wrench(const Span& span);
/// `key` is one of an object's push that is a robot's, or the other way around.
Diagnostic push_key_of_other(const Span& span, const std::string& key, bool is_object);
/// Of a robot file: the frame is the base's, a wheel's or of a link that no motor moves.
Diagnostic pad_off_the_arm(const Span& span, const std::string& frame);
/// Of the signal source `travel_of`.
Diagnostic nothing_travels(const Span& span, const std::string& name);
/// `other`: the noise that such a signal has; empty where it has none.
Diagnostic idle_noise(const Span& span, const std::string& what, const std::string& key,
                      const std::string& other);

}  // namespace zwang::lang::wording

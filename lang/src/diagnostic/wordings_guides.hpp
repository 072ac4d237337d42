/// What is said about objects on hinges, slides and casters.
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
/// Of the signal source `travel_of`.
Diagnostic nothing_travels(const Span& span, const std::string& name);

}  // namespace zwang::lang::wording

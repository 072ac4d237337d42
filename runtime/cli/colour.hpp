/// Colours of a terminal. Texts hold marks for them, which the output turns into escapes or takes away. A
/// colour never tells anything alone: the marked words do.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace zwang::cli {

enum class Hue { bad, warning, good };

/// The text between two marks. Both are characters that Unicode gives to no text, and take no column.
std::string marked(Hue hue, std::string_view text);

/// The text of `lang::render_human` with marks around severities, codes and carets.
std::string with_marked_severities(std::string_view rendered);

/// The text with escapes in the place of its marks; without colour, with nothing there.
std::string shown(std::string_view text, bool in_colour);

/// Whether the descriptor is a terminal with colours, and NO_COLOR (https://no-color.org) is not set.
bool takes_colour(int descriptor) noexcept;

/// The code points of the text, without its marks.
std::size_t columns_of(std::string_view text) noexcept;

}  // namespace zwang::cli

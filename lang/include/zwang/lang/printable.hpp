/// What a file or a name says must not write to the terminal.
#pragma once

#include <string>
#include <string_view>

namespace zwang::lang {

/// Control characters (C0, DEL, C1), characters that make a text look other than it is, and bytes that are
/// not UTF-8 as \xNN, byte by byte; all else as it is. `kept` are control characters that stay.
std::string printable(std::string_view text, std::string_view kept = "\n\t");

}  // namespace zwang::lang

/// Text of files and names that cannot control a terminal.
#pragma once

#include <string>
#include <string_view>

#include "zwang/export.hpp"

namespace zwang::lang {

/// The text with `\xNN` in the place of bytes that must not reach a terminal. These are bytes that are not
/// UTF-8, control characters (C0, DEL, C1), and characters that make a text look other than it is. The
/// control characters in `kept` stay.
ZWANG_EXPORT std::string printable(std::string_view text, std::string_view kept = "\n\t");

/// The same as text or an attribute of XML: in one line, its four marks as entities.
ZWANG_EXPORT std::string printable_in_xml(std::string_view text);

/// The text with one space in the place of every run of spaces, tabs and ends of lines, and none at its ends.
ZWANG_EXPORT std::string in_one_line(std::string_view text);

}  // namespace zwang::lang

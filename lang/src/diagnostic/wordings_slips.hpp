/// What is said about slips that have a literal remedy: letters of a word processor, words in capitals, the
/// wrong kind of file.
#pragma once

#include <string>

#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang::wording {

/// The quantity with its superscripts, dots, signs and commas as zwang writes them: `0,1 m/s²` is
/// `0.1 m/s^2`. The text itself where nothing is to be done.
std::string plainly_written(const std::string& text);
/// Offers that spelling; `plain` reads well.
Diagnostic odd_letters(const Span& span, const std::string& text, const std::string& plain);
/// `AND` for `and`.
Diagnostic word_in_capitals(const Span& span, const std::string& text, const std::string& word);
Diagnostic divides_by_zero(const Span& span);
/// A range of speeds begins at 0.
Diagnostic speed_from_zero(const Span& span, const std::string& what);
Diagnostic urdf_for_robot_file(const Span& span);

}  // namespace zwang::lang::wording

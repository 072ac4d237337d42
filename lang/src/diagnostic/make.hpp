/// Building blocks of wordings.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang::wording {

inline Diagnostic make(const char* code, Severity severity, const Span& span, std::string message,
                       std::string help) {
  Diagnostic diagnostic;
  diagnostic.code = code;
  diagnostic.severity = severity;
  diagnostic.span = span;
  diagnostic.message = std::move(message);
  diagnostic.help = std::move(help);
  return diagnostic;
}

inline Diagnostic error(const std::string& code, const Span& span, std::string message,
                        std::string help = {}) {
  return make(code.c_str(), Severity::error, span, std::move(message), std::move(help));
}

inline Diagnostic warning(const std::string& code, const Span& span, std::string message,
                          std::string help = {}) {
  return make(code.c_str(), Severity::warning, span, std::move(message), std::move(help));
}

/// Offers `text` as what may stand in the span's place.
inline Diagnostic with_replacement(Diagnostic diagnostic, const std::string& text) {
  diagnostic.replacement = text;
  return diagnostic;
}

/// A person chooses among these: none is nearer than the others.
inline Diagnostic with_choices(Diagnostic diagnostic, const std::vector<std::string>& choices) {
  diagnostic.choices = choices;
  return diagnostic;
}

inline Diagnostic with_related(Diagnostic diagnostic, const Span& span, std::string text) {
  diagnostic.related.push_back({span, std::move(text)});
  return diagnostic;
}

/// "did you mean `x`?" with the replacement; unchanged when nothing is near.
inline Diagnostic with_suggestion(Diagnostic diagnostic, const std::string& meant) {
  if (meant.empty()) return diagnostic;
  diagnostic.help = "did you mean `" + meant + "`?";
  diagnostic.replacement = meant;
  return diagnostic;
}

}  // namespace zwang::lang::wording

/// What is said about studies.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang::wording {

/// `known`: what can be drawn here. `missing`: why a name that others have is not among it.
Diagnostic unknown_draw(const Span& span, const std::string& name, const std::optional<std::string>& missing,
                        const std::string& meant, const std::vector<std::string>& known);
/// A drawn cell whose task is refused.
Diagnostic refused_draw(const std::vector<Span>& spans, const std::string& cell, const std::string& code,
                        const std::string& reason, const std::string& place);
/// It exists and still cannot be drawn so: `why` says what is in the way, `help` the way out.
Diagnostic bad_draw(const Span& span, const std::string& why, const std::string& help);
Diagnostic one_distribution(const Span& span, const std::string& name);
Diagnostic bad_distribution(const Span& span, const std::string& why, const std::string& help);
Diagnostic no_certainty(const Span& span, const std::string& what, const std::string& text);
/// Not even without a miss.
Diagnostic too_few_runs(const Span& span, const std::string& probability, const std::string& confidence,
                        std::size_t runs, std::size_t needed);

}  // namespace zwang::lang::wording

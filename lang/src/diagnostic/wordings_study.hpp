/// What is said about studies.
#pragma once

#include <string>
#include <vector>

#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang::wording {

/// `known`: what can be drawn here.
Diagnostic unknown_draw(const Span& span, const std::string& name, const std::string& meant,
                        const std::vector<std::string>& known);
/// It exists and still cannot be drawn so: `why` says what is in the way, `help` the way out.
Diagnostic bad_draw(const Span& span, const std::string& why, const std::string& help);
Diagnostic one_distribution(const Span& span, const std::string& name);
Diagnostic bad_distribution(const Span& span, const std::string& why, const std::string& help);
Diagnostic no_certainty(const Span& span, const std::string& what, const std::string& text);
/// Not even without a miss.
Diagnostic too_few_runs(const Span& span, const std::string& probability, const std::string& confidence,
                        std::size_t runs, std::size_t needed);

}  // namespace zwang::lang::wording

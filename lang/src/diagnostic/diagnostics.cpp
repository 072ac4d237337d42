#include <algorithm>
#include <tuple>

#include "diagnostic/wordings.hpp"
#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang {

namespace {

auto order_of(const Diagnostic& d) {
  // Messages without a place come last: what can be pointed at is read first.
  return std::make_tuple(d.span.exists() ? 0 : 1, d.span.source, d.span.begin.line, d.span.begin.column);
}

bool is_same(const Diagnostic& a, const Diagnostic& b) {
  return a.code == b.code && order_of(a) == order_of(b) && a.message == b.message;
}

}  // namespace

int Diagnostics::add_source(Source source) {
  sources_.push_back(std::move(source));
  return static_cast<int>(sources_.size()) - 1;
}

void Diagnostics::add(Diagnostic diagnostic) {
  // A template's body is read once per use; what is wrong with it is said once.
  const bool known = std::any_of(diagnostics_.begin(), diagnostics_.end(),
                                 [&](const Diagnostic& other) { return is_same(other, diagnostic); });
  if (!known) diagnostics_.push_back(std::move(diagnostic));
}

bool Diagnostics::has_errors() const {
  return error_count() > 0;
}

int Diagnostics::error_count() const {
  return count(Severity::error);
}

int Diagnostics::count(Severity severity) const {
  return static_cast<int>(std::count_if(diagnostics_.begin(), diagnostics_.end(),
                                        [&](const Diagnostic& d) { return d.severity == severity; }));
}

bool Diagnostics::is_allowed(const Diagnostic& d) {
  if (d.severity == Severity::error) return false;
  for (const Allowance& allowance : allowances_) {
    const bool is_meant = allowance.code == d.code && allowance.span.source == d.span.source &&
                          allowance.line == d.span.begin.line;
    if (!is_meant) continue;
    silenced_.push_back({d, allowance.reason});
    return true;
  }
  return false;
}

void Diagnostics::settle() {
  std::erase_if(diagnostics_, [this](const Diagnostic& d) { return is_allowed(d); });
  // Behind an error the checks that warn may not have run.
  if (has_errors()) return;
  for (const Allowance& allowance : allowances_) {
    const bool is_used = std::any_of(silenced_.begin(), silenced_.end(), [&](const Silenced& silenced) {
      return silenced.diagnostic.code == allowance.code &&
             silenced.diagnostic.span.source == allowance.span.source &&
             silenced.diagnostic.span.begin.line == allowance.line;
    });
    if (!is_used) add(wording::idle_allowance(allowance.span, allowance.code, allowance.line));
  }
}

std::vector<Diagnostic> Diagnostics::sorted() const {
  std::vector<Diagnostic> result = diagnostics_;
  std::stable_sort(result.begin(), result.end(),
                   [](const Diagnostic& a, const Diagnostic& b) { return order_of(a) < order_of(b); });
  return result;
}

}  // namespace zwang::lang

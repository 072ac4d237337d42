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

/// Places first: they tell most apart, and thousands are compared where a file is nothing but mistakes. What
/// is wrong with a key of a template's body is the same in every task that uses it.
bool is_same(const Diagnostic& a, const Diagnostic& b) {
  return a.span.begin.line == b.span.begin.line && a.span.begin.column == b.span.begin.column &&
         a.span.source == b.span.source && a.code == b.code && (a.message == b.message || a.code == "E101");
}

/// Of "no frame named `x`" that name.
std::string_view unknown_name_in(const Diagnostic& d) {
  const std::size_t at = d.message.find(" named `");
  if (d.code != "E301" || !d.message.starts_with("no ") || at == std::string::npos) return {};
  return std::string_view(d.message).substr(at);
}

bool are_of_one_cause(const Diagnostic& a, const Diagnostic& b) {
  if (a.message == b.message) return true;
  const std::string_view name = unknown_name_in(a);
  return !name.empty() && name == unknown_name_in(b);
}

/// A name that nobody declared may stand in many places; one declaration mends them all.
bool is_about_a_name(const Diagnostic& d) {
  return d.code == "E301" || d.code == "E303";
}

}  // namespace

int Diagnostics::add_source(Source source) {
  sources_.push_back(std::move(source));
  return static_cast<int>(sources_.size()) - 1;
}

void Diagnostics::add(Diagnostic diagnostic) {
  // A template's body is read once per use; what is wrong with it is said once.
  const bool may_be_elsewhere = is_about_a_name(diagnostic);
  for (Diagnostic& other : diagnostics_) {
    if (is_same(other, diagnostic)) return;
    if (!may_be_elsewhere || !are_of_one_cause(other, diagnostic)) continue;
    other.related.push_back({diagnostic.span, "and here"});
    return;
  }
  diagnostics_.push_back(std::move(diagnostic));
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

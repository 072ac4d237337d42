#include <algorithm>
#include <map>
#include <tuple>

#include "diagnostic/wordings.hpp"
#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang {

namespace {

auto order_of(const Diagnostic& d) {
  // Messages without a place come last: what can be pointed at is read first.
  return std::make_tuple(d.span.exists() ? 0 : 1, d.span.source, d.span.begin.line, d.span.begin.column);
}

/// The places are compared first: they tell most diagnostics apart, and a file full of mistakes needs
/// thousands of comparisons. An unknown key (E101) of a template's body counts once for all tasks that use
/// the template.
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

/// Of "`fast-lane` cannot be a name" the words of its unknown name.
std::string bad_name_in(const Diagnostic& d) {
  const std::size_t end = d.message.find("` cannot be a name");
  return d.code == "E105" && end != std::string::npos ? " named " + d.message.substr(0, end + 1)
                                                      : std::string();
}

bool are_of_one_cause(const Diagnostic& a, const Diagnostic& b) {
  if (a.message == b.message) return true;
  const std::string_view name = unknown_name_in(b);
  // A name that cannot be one is the mistake: where it is used nothing else is wrong.
  return !name.empty() && (name == unknown_name_in(a) || name == bad_name_in(a));
}

/// The edit of a name applies to its uses, too. A span may hold more than the name, as quotes do.
std::optional<std::string> replacement_of_use(const Diagnostic& declared, const Span& use) {
  const std::string name = bad_name_in(declared);
  const auto length = static_cast<int>(name.size()) - static_cast<int>(std::string_view(" named ``").size());
  const bool is_just_it = use.begin.line == use.end.line && use.end.column - use.begin.column == length;
  return !name.empty() && is_just_it ? declared.replacement : std::nullopt;
}

bool is_before(const Position& a, const Position& b) {
  return std::tie(a.line, a.column) < std::tie(b.line, b.column);
}

/// An author who forgets a unit, or writes a wrong one, does so in the whole list. Two wrong units are alike
/// if their message and help are the same.
bool are_units_alike(const Diagnostic& a, const Diagnostic& b) {
  return a.code == b.code && (a.code == "E201" || (a.message == b.message && a.help == b.help));
}

/// A name that nobody declared may stand in many places; one declaration mends them all.
bool is_about_a_name(const Diagnostic& d) {
  return d.code == "E301" || d.code == "E303";
}

}  // namespace

int Diagnostics::add_source(Source source) {
  sources_.push_back(std::move(source));
  collections_.emplace_back();
  return static_cast<int>(sources_.size()) - 1;
}

void Diagnostics::add(Diagnostic diagnostic) {
  // A template's body is read once per use; what is wrong with it is said once.
  const bool may_be_elsewhere = is_about_a_name(diagnostic);
  for (Diagnostic& other : diagnostics_) {
    if (is_same(other, diagnostic)) return;
    if (!may_be_elsewhere || !are_of_one_cause(other, diagnostic)) continue;
    other.related.push_back({diagnostic.span, "and here", replacement_of_use(other, diagnostic.span)});
    return;
  }
  diagnostics_.push_back(std::move(diagnostic));
}

void Diagnostics::add_collection(const Span& span) {
  collections_.at(static_cast<std::size_t>(span.source)).push_back(span);
}

const Span* Diagnostics::collection_around(const Span& span) const {
  if (!span.exists()) return nullptr;
  const std::vector<Span>& all = collections_.at(static_cast<std::size_t>(span.source));
  // Inner ones end first.
  auto around =
      std::partition_point(all.begin(), all.end(), [&](const Span& c) { return is_before(c.end, span.end); });
  around = std::find_if(around, all.end(), [&](const Span& c) { return !is_before(span.begin, c.begin); });
  return around == all.end() ? nullptr : &*around;
}

void Diagnostics::tell_units_together() {
  const auto is_of_units = [](const Diagnostic& d) { return d.code == "E201" || d.code == "E202"; };
  if (std::none_of(diagnostics_.begin(), diagnostics_.end(), is_of_units)) return;
  diagnostics_ = sorted();
  std::multimap<const Span*, std::size_t> first_of;  // what is told first in each collection
  std::vector<Diagnostic> kept;
  for (Diagnostic& d : diagnostics_) {
    const Span* whole = is_of_units(d) ? collection_around(d.span) : nullptr;
    const auto [begin, end] = first_of.equal_range(whole);
    const auto first = whole == nullptr ? end : std::find_if(begin, end, [&](const auto& told) {
      return are_units_alike(kept[told.second], d);
    });
    if (first != end) {
      kept[first->second].related.push_back({d.span, "and here: " + d.help, d.replacement});
      continue;
    }
    if (whole != nullptr) first_of.emplace(whole, kept.size());
    kept.push_back(std::move(d));
  }
  diagnostics_ = std::move(kept);
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
  tell_units_together();
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

std::optional<Diagnostic> Diagnostics::first_error() const {
  for (const Diagnostic& d : sorted()) {
    if (d.severity == Severity::error) return d;
  }
  return std::nullopt;
}

}  // namespace zwang::lang

/// Diagnostics of the front end. Every phase adds to one list, which is rendered in several forms.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/source.hpp"

namespace zwang::lang {

/// `error` refuses the file. `note` is shown on demand.
enum class Severity { note, warning, error };

/// A second place that a diagnostic speaks of.
struct RelatedSpan {
  Span span;
  std::string text;
  std::optional<std::string> replacement;  ///< the literal text that may replace `span`
};

/// One mistake or hint, at its place in the text.
struct Diagnostic {
  std::string code;  ///< stable, as "E201"
  Severity severity = Severity::error;
  Span span;
  std::string message;
  std::vector<RelatedSpan> related;
  std::string help;                        ///< what to write instead; empty when there is nothing to say
  std::optional<std::string> replacement;  ///< the literal text that may replace `span`
  std::vector<std::string> choices;        ///< without a `replacement`: each of them may replace `span`
};

/// A comment `# zwang: allow CODE the reason`: silences warnings and notes of that code on one line.
struct Allowance {
  std::string code;
  std::string reason;
  int line = 0;  ///< that it speaks for, in the source of `span`
  Span span;     ///< of the comment
};

/// What an allowance silenced.
struct Silenced {
  Diagnostic diagnostic;
  std::string reason;
};

/// The list of all diagnostics, and the texts that they point into.
class ZWANG_EXPORT Diagnostics {
 public:
  /// The index of the source, for Span::source.
  int add_source(Source source);
  const std::vector<Source>& sources() const { return sources_; }
  /// Throws std::out_of_range if there is no such source.
  const Source& source(int index) const { return sources_.at(static_cast<std::size_t>(index)); }

  void add(Diagnostic diagnostic);
  /// A list or mapping of a source: those in it come before it. Missing units in the innermost one around
  /// them are one mistake.
  void add_collection(const Span& span);
  bool has_errors() const;
  int error_count() const;
  /// In the order of the text: by source, then position.
  std::vector<Diagnostic> sorted() const;
  std::optional<Diagnostic> first_error() const;  ///< in that order
  const std::vector<Diagnostic>& all() const { return diagnostics_; }
  int count(Severity severity) const;

  void allow(Allowance allowance) { allowances_.push_back(std::move(allowance)); }
  /// Called after all checks: the load functions end with it. Tells the missing units of one list or mapping
  /// together. Takes out diagnostics that an allowance silences, and tells of allowances that silence
  /// nothing.
  void settle();
  const std::vector<Silenced>& silenced() const { return silenced_; }

 private:
  bool is_allowed(const Diagnostic& diagnostic);
  const Span* collection_around(const Span& span) const;
  void tell_units_together();

  std::vector<Source> sources_;
  std::vector<std::vector<Span>> collections_;  ///< of each source, in the order of their ends
  std::vector<Diagnostic> diagnostics_;
  std::vector<Allowance> allowances_;
  std::vector<Silenced> silenced_;
};

struct RenderOptions {
  bool notes = false;  ///< show notes as well
};

/// file:line:column, code, message, the source line with a caret, help.
ZWANG_EXPORT void render_human(const Diagnostics& diagnostics, std::ostream& out,
                               const RenderOptions& options = {});
/// `file:line:column: error E201: message`, one line each.
ZWANG_EXPORT void render_short(const Diagnostics& diagnostics, std::ostream& out,
                               const RenderOptions& options = {});
/// One JSON array, a diagnostic an object with its range and the edits that would mend it; for editors. Lines
/// and columns from 1, columns in code points, ends exclusive.
ZWANG_EXPORT std::string render_json(const Diagnostics& diagnostics, const RenderOptions& options = {});
/// A SARIF 2.1.0 log with one run; what allowances silenced is in it, marked as suppressed. `version` is the
/// program's.
ZWANG_EXPORT std::string render_sarif(const std::vector<const Diagnostics*>& files,
                                      const std::string& version, const RenderOptions& options = {});

}  // namespace zwang::lang

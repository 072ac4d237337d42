/// What the front end has to say to an author: one list that every phase writes into, rendered in several
/// forms.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "zwang/lang/source.hpp"

namespace zwang::lang {

enum class Severity { note, warning, error };

struct RelatedSpan {
  Span span;
  std::string text;
};

struct Diagnostic {
  std::string code;  ///< stable, as "E201"
  Severity severity = Severity::error;
  Span span;
  std::string message;
  std::vector<RelatedSpan> related;
  std::string help;                        ///< what to write instead; empty when there is nothing to say
  std::optional<std::string> replacement;  ///< the literal text that may replace `span`
};

class Diagnostics {
 public:
  int add_source(Source source);
  const std::vector<Source>& sources() const { return sources_; }
  const Source& source(int index) const { return sources_.at(static_cast<std::size_t>(index)); }

  void add(Diagnostic diagnostic);
  bool has_errors() const;
  int error_count() const;
  /// In the order of the text: by source, then position.
  std::vector<Diagnostic> sorted() const;
  const std::vector<Diagnostic>& all() const { return diagnostics_; }

 private:
  std::vector<Source> sources_;
  std::vector<Diagnostic> diagnostics_;
};

/// file:line:column, code, message, the source line with a caret, help.
void render_human(const Diagnostics& diagnostics, std::ostream& out);
/// One JSON array, a diagnostic an object with its range; for editors.
std::string render_json(const Diagnostics& diagnostics);

}  // namespace zwang::lang

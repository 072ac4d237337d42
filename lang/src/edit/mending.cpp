#include "zwang/lang/mending.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <vector>

#include "words/text.hpp"
#include "zwang/lang/open_texts.hpp"

namespace zwang::lang {

namespace {

namespace fs = std::filesystem;

/// Each check reads all files anew: 64 of them take less than a second for the files that ship.
constexpr int most_checks = 64;

struct TextEdit {
  Span span;
  std::string text;
};

std::vector<TextEdit> edits_by_source(const Diagnostic& d) {
  std::vector<TextEdit> edits;
  if (d.replacement && d.span.exists()) edits.push_back({d.span, *d.replacement});
  for (const RelatedSpan& related : d.related) {
    if (related.replacement && related.span.exists()) edits.push_back({related.span, *related.replacement});
  }
  return edits;
}

/// The texts with all edits made. The last one of a text comes first, so that places before it stay.
OpenTexts edited_texts(const Diagnostics& diagnostics, std::vector<TextEdit> edits) {
  std::sort(edits.begin(), edits.end(), [](const TextEdit& a, const TextEdit& b) {
    return std::tie(a.span.begin.line, a.span.begin.column) >
           std::tie(b.span.begin.line, b.span.begin.column);
  });
  std::map<int, std::string> texts;
  for (const TextEdit& edit : edits) {
    const std::string& original = diagnostics.source(edit.span.source).text;
    const TextIndex index(original);
    std::string& text = texts.try_emplace(edit.span.source, original).first->second;
    const std::size_t begin = index.offset(edit.span.begin), end = index.offset(edit.span.end);
    text.replace(begin, std::max(begin, end) - begin, edit.text);
  }
  OpenTexts open = open_texts();
  for (auto& [source, text] : texts) open.put(diagnostics.source(source).path, std::move(text));
  return open;
}

/// The lines that an edit writes.
struct WrittenLines {
  fs::path file;
  int first = 0, last = 0;
};

bool is_among(const Diagnostics& diagnostics, const Diagnostic& d, const std::vector<WrittenLines>& written) {
  if (!d.span.exists()) return false;
  const fs::path file = canonical_name(diagnostics.source(d.span.source).path);
  return std::any_of(written.begin(), written.end(), [&](const WrittenLines& lines) {
    return lines.file == file && lines.first <= d.span.begin.line && d.span.begin.line <= lines.last;
  });
}

bool says_the_same(const Diagnostic& a, const Diagnostic& b) {
  return a.code == b.code && a.message == b.message;
}

}  // namespace

bool mends(FileKind kind, const fs::path& path, const CheckOptions& options, const Diagnostics& before,
           const Diagnostic& d) {
  const std::vector<TextEdit> edits = edits_by_source(d);
  if (edits.empty()) return false;
  std::vector<WrittenLines> written;
  for (const TextEdit& edit : edits) {
    const int first = edit.span.begin.line;
    const auto more = std::count(edit.text.begin(), edit.text.end(), '\n');
    written.push_back(
        {canonical_name(before.source(edit.span.source).path), first, first + static_cast<int>(more)});
  }
  const OpenTexts texts = edited_texts(before, edits);
  const ReadsOpenTexts reading(texts);
  Diagnostics after;
  check_file(kind, path, options, after);
  const auto times_told = [&](const Diagnostics& in) {
    return std::count_if(in.all().begin(), in.all().end(), [&](const Diagnostic& told) {
      return says_the_same(told, d) && is_among(in, told, written);
    });
  };
  if (times_told(after) >= times_told(before)) return false;
  const auto is_worse = [&](const Diagnostic& found) {
    if (!is_among(after, found, written)) return false;
    const auto is_it = [&](const Diagnostic& old) { return says_the_same(old, found); };
    return found.severity == Severity::error && std::none_of(before.all().begin(), before.all().end(), is_it);
  };
  return std::none_of(after.all().begin(), after.all().end(), is_worse);
}

Diagnostics with_mending_edits(FileKind kind, const fs::path& path, const CheckOptions& options,
                               const Diagnostics& before) {
  int checks = 0;
  const auto is_kept = [&](const Diagnostic& d) {
    return ++checks <= most_checks && mends(kind, path, options, before, d);
  };
  Diagnostics after;
  for (const Source& source : before.sources()) after.add_source(source);
  for (Diagnostic d : before.all()) {
    if (d.replacement && !is_kept(d)) {
      d.replacement.reset();
      for (RelatedSpan& related : d.related) related.replacement.reset();
    }
    std::erase_if(d.choices, [&](const std::string& choice) {
      Diagnostic chosen = d;
      chosen.replacement = choice;
      return !is_kept(chosen);
    });
    after.add(std::move(d));
  }
  for (const Silenced& silenced : before.silenced()) {
    const Span& span = silenced.diagnostic.span;
    after.allow({silenced.diagnostic.code, silenced.reason, span.begin.line, span});
    after.add(silenced.diagnostic);
  }
  after.settle();
  return after;
}

}  // namespace zwang::lang

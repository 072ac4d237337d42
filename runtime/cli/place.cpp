#include "output.hpp"

namespace zwang::cli {

std::string place(const lang::Diagnostics& diagnostics, const lang::Span& span) {
  if (!span.exists()) return "";
  const std::filesystem::path path = diagnostics.source(span.source).path;
  return path.filename().string() + ":" + std::to_string(span.begin.line);
}

}  // namespace zwang::cli

# Writes OUT, which defines `catalogue::pages`: the text of each file of PAGES, docs/errors/CODE.md, in the order of PAGES.
set(text "// Made of docs/errors.\n#include \"explain/pages.hpp\"\n\nnamespace zwang::lang::catalogue {\n\n")
string(APPEND text "std::span<const std::string_view> pages() {\n  static constexpr std::string_view all[] = {\n")
foreach(page IN LISTS PAGES)
  file(READ "${page}" words)
  string(APPEND text "R\"page(${words})page\",\n")
endforeach()
string(APPEND text "  };\n  return all;\n}\n\n}  // namespace zwang::lang::catalogue\n")
file(WRITE "${OUT}" "${text}")

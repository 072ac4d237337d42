/// Places in the text of the files that the author wrote.
#pragma once

#include <string>

namespace zwang::lang {

/// A place in a text.
struct Position {
  int line = 0;    ///< from 1; 0 when there is no text
  int column = 0;  ///< from 1, in code points
};

/// A stretch of text, `end` exclusive.
struct Span {
  int source = -1;  ///< index into Diagnostics::sources(); -1 when there is no text
  Position begin;
  Position end;

  bool exists() const { return source >= 0; }
};

/// A file as it was read, once.
struct Source {
  std::string path;
  std::string text;
};

}  // namespace zwang::lang

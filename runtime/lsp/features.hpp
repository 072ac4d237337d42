/// The questions of an editor about a place in a text. Each returns the `result` of its request; `null` where
/// there is nothing to say.
#pragma once

#include <stdexcept>

#include "json.hpp"

namespace zwang::lsp {

/// The request cannot be done; what() says why, for people.
class Refused : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A place in an open file of zwang's.
struct Asked {
  const Workspace& workspace;
  std::filesystem::path file;
  const Document& document;
  lang::FileKind kind;
  EditorPosition position;
};

/// The rows of an axis on this robot, the meaning of a key, a quantity in SI.
Json hover(const Asked& asked);

/// Keys, words, names and units that fit.
Json completion(const Asked& asked);

/// Where the name at the place is given: a location.
Json definition(const Asked& asked);
/// All places of the name, over the files that share it.
Json references(const Asked& asked);
/// The names that a file gives.
Json symbols(const Asked& asked);
/// The range of the name at the place, if it can have another.
Json prepare_rename(const Asked& asked);
/// The edits that give it another name in task, scenes, scenarios and connections. Throws Refused where the
/// name is none, is another file's, or where a file would have errors afterwards that it has not now.
Json rename(const Asked& asked, const std::string& new_name);

}  // namespace zwang::lsp

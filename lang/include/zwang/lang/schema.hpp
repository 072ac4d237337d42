/// JSON Schemas (draft 7) of zwang's files, for editors: completion, hover texts, the first check while
/// typing.
#pragma once

#include <string>

#include "zwang/export.hpp"
#include "zwang/lang/file_kind.hpp"

namespace zwang::lang {

/// The schema of a file: keys, shapes, and whether a text looks like a quantity. `load` judges names,
/// dimensions and everything else.
ZWANG_EXPORT std::string json_schema(FileKind kind);

}  // namespace zwang::lang

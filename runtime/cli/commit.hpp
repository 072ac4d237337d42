/// The commit that the program was built from.
#pragma once

namespace zwang::cli {

/// Abbreviated; empty where the sources are no checkout of git.
extern const char* const commit;

}  // namespace zwang::cli

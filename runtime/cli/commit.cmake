# cmake -D SOURCE=... -D OUT=... -P commit.cmake: writes the file that names the commit of the sources.
execute_process(COMMAND git -C ${SOURCE} rev-parse --short=10 HEAD OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE
  ERROR_QUIET RESULT_VARIABLE is_no_checkout)
if(is_no_checkout)
  set(commit "")
endif()
file(WRITE ${OUT}
"#include \"commit.hpp\"

namespace zwang::cli {

const char* const commit = \"${commit}\";

}  // namespace zwang::cli
")

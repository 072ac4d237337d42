#include "zwang/lang/schema.hpp"

#include "output.hpp"
#include "verbs.hpp"

namespace zwang::cli {

int schema(const SchemaArguments& arguments) {
  print_data(lang::json_schema(arguments.kind));
  return exit_good;
}

}  // namespace zwang::cli

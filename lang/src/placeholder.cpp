#include "zwang/lang/program.hpp"

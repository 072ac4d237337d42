// sweep [--seed N] [--first N] [--runs N] [--threads N] [--healthy | --faulty | --others | --sound-others |
// --released | --starts]: draws runs and prints what they came to.
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>

#include "table.hpp"

int main(int argc, char** argv) {
  using namespace zwang::sweep;
  int seed = 1, first = 0, runs = 60, threads = 1;
  Which which = Which::all;
  for (int i = 1; i < argc; ++i) {
    int* number = nullptr;
    if (std::strcmp(argv[i], "--seed") == 0) number = &seed;
    if (std::strcmp(argv[i], "--first") == 0) number = &first;
    if (std::strcmp(argv[i], "--runs") == 0) number = &runs;
    if (std::strcmp(argv[i], "--threads") == 0) number = &threads;
    if (std::strcmp(argv[i], "--healthy") == 0) which = Which::healthy;
    if (std::strcmp(argv[i], "--faulty") == 0) which = Which::faulty;
    if (std::strcmp(argv[i], "--others") == 0) which = Which::others;
    if (std::strcmp(argv[i], "--sound-others") == 0) which = Which::sound_others;
    if (std::strcmp(argv[i], "--released") == 0) which = Which::released;
    if (std::strcmp(argv[i], "--starts") == 0) which = Which::starts;
    if (number != nullptr && i + 1 < argc) *number = std::atoi(argv[++i]);
  }
  try {
    const auto results = run_all(static_cast<std::uint64_t>(seed), first, runs, which, threads);
    print(static_cast<std::uint64_t>(seed), first, which, results, std::cout);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 2;
  }
}

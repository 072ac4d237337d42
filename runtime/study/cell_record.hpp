/// The figures that a study keeps of a cell.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "zwang/lang/diagnostic.hpp"
#include "zwang/lang/study.hpp"

namespace zwang::study {

struct ExpectationRecord {
  bool held = false;
  std::optional<double> margin, value;  ///< as runtime::ExpectationResult
};

struct CellRecord {
  std::size_t cell = 0;
  std::string of_matrix;  ///< the cell of the scenario that was drawn
  /// As runtime::CellResult, and `hung` past the time limit, `crashed` with its process.
  std::string outcome;
  std::string because, why;
  double simulated = 0.0;  ///< [s]
  double torque = 0.0;     ///< share of its limit, of the motor that came nearest to it
  double wall = 0.0;       ///< [s] of real time: of all figures the only one that another run does not repeat
  std::vector<double> drawn;                    ///< parallel to Study::draws, SI
  std::vector<ExpectationRecord> expectations;  ///< parallel to Study::claims

  bool holds() const;
};

/// With what the cell draws, and nothing held.
CellRecord unrun(const lang::Study& study, std::size_t cell, const std::string& outcome,
                 const std::string& because);

/// Draws, loads and runs the cell.
CellRecord run_cell(const lang::Study& study, std::size_t cell);

/// Of errors and warnings, each once.
std::vector<std::string> codes_of(const lang::Diagnostics& diagnostics);

/// Each run makes a simulation of 100 MB twice, and frees it. Where the pages go back to the system, it costs
/// four times what the run does to get them anew.
void keep_freed_memory();

/// Through a pipe, without the loss of a bit.
std::string to_text(const CellRecord& record);
CellRecord record_of(const std::string& text);

}  // namespace zwang::study

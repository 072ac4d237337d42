/// The inputs of a tick from outside as columns of the log, with every digit: the snapshot and the
/// parameters.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "zwang/lang/program.hpp"
#include "zwang/runtime/plant.hpp"
#include "zwang/runtime/recorder.hpp"

namespace zwang::runtime {

/// Most entries are 0 on most ticks: those are left blank. A non-finite number is written as an infinity, and
/// read back as NaN.
class SensedColumns {
 public:
  SensedColumns(const solver::Model& model, const std::vector<lang::Signal>& signals,
                const std::vector<lang::Parameter>& parameters, const lang::Drive& drive);

  const std::vector<Column>& columns() const noexcept { return columns_; }
  /// Where a snapshot has each of the signals; without it in their own order. Does not allocate.
  void signals_at(const std::vector<std::size_t>& places) noexcept;
  /// As many values as columns. Does not allocate. `parameters` as they stood when the tick began.
  void write(const Sensed& sensed, std::span<const double> parameters,
             std::span<double> values) const noexcept;
  /// `sensed` as it was sized for the model and the signals, `parameters` for the parameters; NaN for one
  /// that the log does not have.
  void read(std::span<const double> values, Sensed& sensed, std::span<double> parameters) const noexcept;

 private:
  void name(const std::string& of, std::initializer_list<const char*> parts);

  std::vector<lang::SignalType> types_;
  std::vector<std::size_t> places_;
  bool has_stamped_samples_;  ///< of a drive that takes velocities
  lang::Feels::By feels_;
  std::size_t first_parameter_ = 0;
  std::vector<Column> columns_;
};

}  // namespace zwang::runtime

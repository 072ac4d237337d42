/// The results of a study in one SQLite file: what resumes, reports, and `sqlite3` or Python reads.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "study/cell_record.hpp"

namespace zwang::study {

/// The study that a file of results belongs to. Other texts, another version or seed make another study.
struct StudyIdentity {
  std::string fingerprint;
  std::string path;  ///< of its file, absolute
  std::vector<std::string> draws, units;
  std::vector<lang::Claim> claims;
};
StudyIdentity identity_of(const lang::Study& study, const std::string& fingerprint);

/// Tables: `cells`, a row each with a column of each draw and with held_N, margin_N, value_N of expectation
/// N; `expectations`, `draws` and `study`. Another process may read while it grows.
class ResultStore {
 public:
  /// Throws std::runtime_error where the file cannot be written, or is made for something else.
  ResultStore(const std::string& path, const StudyIdentity& identity);
  ~ResultStore();
  /// Throws where the file holds something else than results of this study, whatever its texts were then.
  static void require_results_of(const StudyIdentity& identity, const std::string& path);

  /// Without those that hung or crashed, which may be the machine's fault.
  std::set<std::size_t> ended_cells() const;
  /// Kept by the next `keep`, and by each 256th cell: a process that is killed loses no more.
  void put(const CellRecord& record);
  /// What was put is on its way to the disk, and others can read it.
  void keep();
  /// In the order of the cells, below `runs`: each `of`-th, from `first` on.
  std::vector<CellRecord> records(std::size_t runs, std::size_t first = 0, std::size_t of = 1) const;
  /// All cells of another file of the same study, which is only read. A cell that hung or crashed there
  /// does not replace one that ended. Throws where the file is made for something else.
  void merge(const std::string& path);

 private:
  void make_tables();
  struct Database;
  std::unique_ptr<Database> database_;
  StudyIdentity identity_;
};

}  // namespace zwang::study

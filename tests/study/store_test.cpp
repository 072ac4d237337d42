// The file of results: what goes in comes out, to the bit, and one of another study is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "../temporary_folder.hpp"
#include "study/result_store.hpp"

namespace zwang::study {
namespace {

StudyIdentity made_identity(const std::string& fingerprint) {
  StudyIdentity identity;
  identity.fingerprint = fingerprint;
  identity.draws = {"draw.params.push", "draw.with \"quotes\""};
  identity.units = {"N", ""};
  identity.claims.resize(2);
  identity.claims[0].text = "outcome: done";
  identity.claims[0].probability = 0.999;
  return identity;
}

CellRecord made_record(std::size_t cell) {
  CellRecord record;
  record.cell = cell;
  record.of_matrix = "robot diff_base";
  record.outcome = "failed";
  record.because = "it's `so`; \xC3\xA9";
  record.simulated = 1.0 / 3.0;
  record.torque = std::nextafter(0.9, 1.0);
  record.drawn = {0.1 + 0.2, -5e-324};
  record.expectations = {{false, std::nullopt, std::nullopt}, {true, -1e-17, 3.0}};
  return record;
}

void expect_same(const CellRecord& a, const CellRecord& b) {
  EXPECT_EQ(a.cell, b.cell);
  EXPECT_EQ(a.of_matrix, b.of_matrix);
  EXPECT_EQ(a.outcome, b.outcome);
  EXPECT_EQ(a.because, b.because);
  EXPECT_EQ(a.why, b.why);
  EXPECT_EQ(a.simulated, b.simulated);
  EXPECT_EQ(a.torque, b.torque);
  EXPECT_EQ(a.wall, b.wall);
  EXPECT_EQ(a.drawn, b.drawn);
  ASSERT_EQ(a.expectations.size(), b.expectations.size());
  for (std::size_t i = 0; i < a.expectations.size(); ++i) {
    EXPECT_EQ(a.expectations[i].held, b.expectations[i].held);
    EXPECT_EQ(a.expectations[i].margin, b.expectations[i].margin);
    EXPECT_EQ(a.expectations[i].value, b.expectations[i].value);
  }
}

class Store : public testing::Test {
 protected:
  std::string file(const std::string& name) const { return (folder_.path() / name).string(); }

 private:
  test::TemporaryFolder folder_;
};

TEST_F(Store, KeepsEveryBit) {
  {
    ResultStore store(file("a.db"), made_identity("1"));
    store.put(made_record(7));
    store.put(made_record(2));
    store.put(made_record(7));  // once more, as after a kill
  }
  const ResultStore again(file("a.db"), made_identity("1"));
  EXPECT_EQ(again.ended_cells(), (std::set<std::size_t>{2, 7}));
  const auto records = again.records(100);
  ASSERT_EQ(records.size(), 2u);
  expect_same(records[0], made_record(2));
  expect_same(records[1], made_record(7));
  EXPECT_EQ(again.records(7).size(), 1u);
}

/// Another process reads while the file grows: as far as it is kept.
TEST_F(Store, ShowsOthersWhatIsKept) {
  ResultStore store(file("a.db"), made_identity("1"));
  const ResultStore reader(file("a.db"), made_identity("1"));
  store.put(made_record(3));
  EXPECT_TRUE(reader.ended_cells().empty());
  store.keep();
  EXPECT_EQ(reader.ended_cells(), (std::set<std::size_t>{3}));
  for (std::size_t cell = 10; cell < 10 + 256; ++cell) store.put(made_record(cell));
  EXPECT_EQ(reader.ended_cells().size(), 257u);
}

TEST_F(Store, OfAnotherStudyIsRefused) {
  { const ResultStore store(file("a.db"), made_identity("1")); }
  EXPECT_THROW(ResultStore(file("a.db"), made_identity("2")), std::runtime_error);
  std::ofstream(file("text.db")) << "this is not a database, but it is long enough to be read as one\n";
  EXPECT_THROW(ResultStore(file("text.db"), made_identity("1")), std::runtime_error);
  EXPECT_THROW(ResultStore(file("no/such/folder.db"), made_identity("1")), std::runtime_error);
}

TEST_F(Store, TakesTheCellsOfOthers) {
  ResultStore store(file("a.db"), made_identity("1"));
  store.put(made_record(0));
  {
    ResultStore other(file("b.db"), made_identity("1"));
    other.put(made_record(1));
  }
  { const ResultStore stranger(file("c.db"), made_identity("2")); }
  store.merge(file("b.db"));
  EXPECT_EQ(store.ended_cells(), (std::set<std::size_t>{0, 1}));
  EXPECT_THROW(store.merge(file("c.db")), std::runtime_error);
  EXPECT_THROW(store.merge(file("missing.db")), std::runtime_error);
}

/// The same study with other texts is its own; another one's results are not deleted for it.
TEST_F(Store, IsDeletedForItsOwnStudyAlone) {
  StudyIdentity of_other = made_identity("2");
  of_other.path = "/tasks/other.yaml";
  { const ResultStore store(file("other.db"), of_other); }
  EXPECT_THROW(ResultStore::require_results_of(made_identity("1"), file("other.db")), std::runtime_error);
  of_other.fingerprint = "3";
  EXPECT_NO_THROW(ResultStore::require_results_of(of_other, file("other.db")));
  EXPECT_NO_THROW(ResultStore::require_results_of(of_other, file("missing.db")));
  EXPECT_FALSE(std::filesystem::exists(file("missing.db")));
}

/// Read-only media and files of others can be joined, too; one without tables has lost its log.
TEST_F(Store, OnlyReadsWhatItMerges) {
  namespace fs = std::filesystem;
  const std::string part = file("50 %? #1.db");
  {
    ResultStore other(part, made_identity("1"));
    other.put(made_record(1));
  }
  const auto written = fs::last_write_time(part);
  fs::permissions(part, fs::perms::owner_read);
  ResultStore store(file("a.db"), made_identity("1"));
  store.merge(part);
  EXPECT_EQ(store.ended_cells(), (std::set<std::size_t>{1}));
  EXPECT_EQ(fs::last_write_time(part), written);
  EXPECT_FALSE(fs::exists(part + "-shm"));
  std::ofstream(file("empty.db")) << "";
  EXPECT_THROW(store.merge(file("empty.db")), std::runtime_error);
  EXPECT_EQ(fs::file_size(file("empty.db")), 0u);
}

/// A machine that was busy, or short of memory, is no verdict on the cell.
TEST_F(Store, CellsThatHungOrCrashedRunAgain) {
  const auto that_is = [](std::size_t cell, const char* outcome) {
    CellRecord record = made_record(cell);
    record.outcome = outcome;
    return record;
  };
  ResultStore store(file("a.db"), made_identity("1"));
  for (const CellRecord& record : {that_is(0, "done"), that_is(1, "hung"), that_is(2, "crashed")})
    store.put(record);
  store.keep();
  EXPECT_EQ(store.ended_cells(), (std::set<std::size_t>{0}));
  EXPECT_EQ(store.records(3).size(), 3u);
  {
    ResultStore other(file("b.db"), made_identity("1"));
    for (const CellRecord& record : {that_is(0, "hung"), that_is(1, "done"), that_is(3, "hung")})
      other.put(record);
  }
  store.merge(file("b.db"));
  std::string outcomes;
  for (const CellRecord& record : store.records(10)) outcomes += record.outcome + " ";
  EXPECT_EQ(outcomes, "done done crashed hung ");
  EXPECT_EQ(store.records(10, 1, 2).size(), 2u);  // 1 and 3
}

TEST(Records, AreTextWithoutTheLossOfABit) {
  expect_same(record_of(to_text(made_record(3))), made_record(3));
  CellRecord odd = made_record(4);
  odd.because = "not UTF-8: \xFF";
  EXPECT_EQ(record_of(to_text(odd)).drawn, odd.drawn);
}

}  // namespace
}  // namespace zwang::study

// A remedy is noted with the iteration after it, and with no other.
#include "majorant/framework/run_record.h"

#include <gtest/gtest.h>

namespace majorant {
namespace {

std::optional<Remedy> noted(RunRecord& record) {
  record.observer(1)({}, {});
  return record.trace().back().remedy;
}

TEST(RunRecord, NotesARemedyOnce) {
  RunRecord record;
  EXPECT_EQ(noted(record), std::nullopt);
  record.mark(Remedy::Exclude);
  EXPECT_EQ(noted(record), Remedy::Exclude);
  EXPECT_EQ(noted(record), std::nullopt);
}

TEST(RunRecord, ForgetsARemedyThatNoIterationFollowed) {
  RunRecord record;
  record.mark(Remedy::Deepen);
  record.forget_mark();
  EXPECT_EQ(noted(record), std::nullopt);
}

}  // namespace
}  // namespace majorant

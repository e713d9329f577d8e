// Compiled with the session of a program without MPI, whether MPI is there or not.
#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "sim/parallel/rank_session.hpp"

namespace earshot::parallel {
namespace {

TEST(RankSessionAlone, IsOneProcessWithItsOwnErrors) {
  RankSession session;
  EXPECT_EQ(session.ranks().rank(), 0U);
  EXPECT_EQ(session.ranks().size(), 1U);
  EXPECT_GE(session.processors(), 1U);
  EXPECT_EQ(session.first_error("mine"), "mine");
  std::vector<std::int32_t> values{1, 2};
  session.ranks().share(values);
  EXPECT_EQ(values, (std::vector<std::int32_t>{1, 2}));
}

TEST(RankSessionAlone, RefusesToBeOneOfManyThatWouldWriteTheSameFile) {
  for (const char* variable : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {
    setenv(variable, "1", 1);
    EXPECT_NO_THROW(RankSession{});
    setenv(variable, "2", 1);
    EXPECT_THROW(RankSession{}, std::runtime_error) << variable;
    unsetenv(variable);
  }
  setenv("PMIX_RANK", "0", 1);  // alone, or the one that writes
  EXPECT_NO_THROW(RankSession{});
  setenv("PMIX_RANK", "1", 1);
  EXPECT_THROW(RankSession{}, std::runtime_error);
  unsetenv("PMIX_RANK");
}

}  // namespace
}  // namespace earshot::parallel

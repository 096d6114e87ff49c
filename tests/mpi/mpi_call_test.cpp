// A failing MPI call says which call failed, on which rank, and why.
#include "distributed/mpi/mpi_call.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include "base/error.h"
#include "distributed/mpi/mpi_sum.h"

namespace lucarne::mpi_call_test {
namespace {

/// MPI in this process alone, for all tests of the program: it can be started only once.
class MpiAlone : public testing::Environment {
 public:
  void SetUp() override {
    for (const char* variable : {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"})
      ::setenv(variable, "1", 1);
    MPI_Init(nullptr, nullptr);
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
  }
  void TearDown() override { MPI_Finalize(); }
};
const auto* const environment = testing::AddGlobalTestEnvironment(new MpiAlone);

TEST(MpiCall, AFailureNamesCallRankAndReason) {
  const int number = 1;
  const int code = MPI_Send(&number, 1, MPI_INT, 99, 0, MPI_COMM_WORLD);
  ASSERT_NE(code, MPI_SUCCESS);
  try {
    checkMpi(code, "MPI_Send");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::failed);
    EXPECT_THAT(error.what(), testing::StartsWith("MPI_Send failed on rank 0: MPI_ERR_RANK"));
  }
}

TEST(MpiCall, SuccessSaysNothing) { EXPECT_NO_THROW(checkMpi(MPI_SUCCESS, "MPI_Send")); }

TEST(MpiSum, OfOneRankIsItsOwnTallies) {
  Tallies tallies(3'000'000, 10);  // more than one block
  for (std::size_t i = 0; i < tallies.light().size(); ++i) tallies.light()[i] = static_cast<std::int64_t>(i) << 40;
  tallies.statistics()[7] = 9;
  const Hash128 before = tallies.contentHash();
  sumTallies(MPI_COMM_WORLD, tallies);
  EXPECT_EQ(tallies.contentHash(), before);
}

}  // namespace
}  // namespace lucarne::mpi_call_test

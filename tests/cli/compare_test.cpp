// Pictures and light maps judged by the program.
#include "tests/cli/program.h"

namespace lucarne::compare_test {
namespace {

class Compare : public test::ProgramTest {
 protected:
  void bake(const std::string& name, const std::string& options) {
    mustRun("bake" + std::string(test::kQuickScene) + "--photons 50k --density 6 --quiet -o " + name + " " + options);
  }
  void expectRefusal(const std::string& arguments, int code, const std::string& words) const {
    const test::ProgramOutcome o = run(arguments);
    EXPECT_EQ(o.code, code) << arguments << "\n" << o.err;
    EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << o.err;
    EXPECT_NE(o.err.find(words), std::string::npos) << o.err;
  }
};

TEST_F(Compare, LightMapsPassTheirLimitsOrEndWithOne) {
  bake("a.dlm", "--seed 1");
  bake("b.dlm", "--seed 2");
  EXPECT_EQ(run("compare a.dlm a.dlm --max-rmse 0 --max-relative 0").code, 0);
  const test::ProgramOutcome o = run("compare a.dlm b.dlm --json");
  EXPECT_EQ(o.code, 0) << o.err;
  const auto d = nlohmann::json::parse(o.out);
  EXPECT_EQ(d["kind"], "light maps");
  EXPECT_GT(d["irradiance"]["relative_error"].get<double>(), 0.0);
  expectRefusal("compare a.dlm b.dlm --max-relative 0.01%", 1, "differ too much: relative error");
  EXPECT_NE(run("compare a.dlm b.dlm --max-relative 0.01%").out.find("RMSE"), std::string::npos)
      << "the result is told all the same";
}

TEST_F(Compare, WrongUsageIsRefusedInOneLine) {
  bake("a.dlm", "");
  expectRefusal("compare a.dlm", 2, "B is required");
  expectRefusal("compare a.dlm a.dlm --max-flip 0.1", 2, "--max-flip");
  expectRefusal("compare a.dlm a.dlm --max-rmse=-1", 2, "--max-rmse");
  expectRefusal("compare a.dlm a.dlm --points 0", 2, "--points");
  expectRefusal("compare a.dlm none.dlm", 3, "none.dlm");
  expectRefusal("compare a.dlm a.dlm/irradiance.exr", 2, "one of each");
  EXPECT_EQ(run("compare a.dlm/irradiance.exr a.dlm/irradiance.exr --max-flip 0").code, 0);
}

}  // namespace
}  // namespace lucarne::compare_test

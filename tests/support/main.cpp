#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>
#include <support/skip.hpp>

#include <atomic>
#include <cstdio>

namespace {

constexpr int all_skipped = 77;  // SKIP_RETURN_CODE of the tests

std::atomic<bool> case_skips = false;  // of the case that runs
int cases = 0;
int skipped = 0;         // cases that checked nothing
int partly_skipped = 0;  // cases that checked something

/// Counts; says nothing.
class skip_counter : public doctest::IReporter {
  public:
    explicit skip_counter(const doctest::ContextOptions&) {}

    void test_case_start(const doctest::TestCaseData&) override { case_skips = false; }
    void test_case_end(const doctest::CurrentTestCaseStats& stats) override {
        ++cases;
        if (case_skips) ++(stats.numAssertsCurrentTest > 0 ? partly_skipped : skipped);
    }

    void report_query(const doctest::QueryData&) override {}
    void test_run_start() override {}
    void test_run_end(const doctest::TestRunStats&) override {}
    void test_case_reenter(const doctest::TestCaseData&) override {}
    void test_case_exception(const doctest::TestCaseException&) override {}
    void subcase_start(const doctest::SubcaseSignature&) override {}
    void subcase_end() override {}
    void log_assert(const doctest::AssertData&) override {}
    void log_message(const doctest::MessageData&) override {}
    void test_case_skipped(const doctest::TestCaseData&) override {}
};
DOCTEST_REGISTER_LISTENER("skip_counter", 1, skip_counter);

}  // namespace

void test::skip_part(const std::string& why) {
    case_skips = true;
    MESSAGE("skipped: " << why);
}

int main(int argc, char** argv) {
    doctest::Context context(argc, argv);
    const int status = context.run();
    if (context.shouldExit()) return status;  // asked for a list alone
    if (cases == 0) {                         // of a source that has another name by now
        std::fprintf(stderr, "no test case is of that name or in that file\n");
        return 1;
    }
    if (skipped + partly_skipped > 0)  // tests/house/count_tests.py reads this line
        std::printf("%d of %d test cases skipped, %d in part\n", skipped, cases, partly_skipped);
    return status == 0 && skipped == cases ? all_skipped : status;
}

#pragma once
/// \file
/// Test cases that cannot do their work here say so.

#include <string>

namespace test {

/// Notes that a part of what the running test case checks is left out, and why; the case goes on. A
/// program all of whose cases were left out ends with the status that ctest prints as "Skipped";
/// others print how many were.
void skip_part(const std::string& why);

}  // namespace test

/// Ends the test case, or a function without a result that it calls, as skipped.
#define SKIP_CASE(why)        \
    do {                      \
        test::skip_part(why); \
        return;               \
    } while (false)

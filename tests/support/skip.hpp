#pragma once
/// \file
/// Test cases that cannot do their work here say so.

#include <string>

namespace test {

/// Notes that what the running test case checks, or a part of it, is left out, and why. A program
/// all of whose cases were left out ends with the status that ctest prints as "Skipped"; others
/// print how many were.
void skip(const std::string& why);

}  // namespace test

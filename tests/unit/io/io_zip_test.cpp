// Archives of 3MF packages as other programs write them: ZIP64, streamed, stored and deflated.

#include <treeform/mesh/properties.hpp>
#include <treeform/mesh/read.hpp>
#include <treeform/tf.hpp>

#include <doctest/doctest.h>
#include <support/packages.hpp>

#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace {

const std::string packed_model =
    test::model_text("<resources><object id=\"1\">" + test::tetrahedron_3mf +
                     "</object></resources><build><item "
                     "objectid=\"1\"/></build>");

/// Every form that one bit makes another.
std::vector<test::zip_form> all_zip_forms() {
    std::vector<test::zip_form> forms;
    for (unsigned bits = 0; bits < 32; ++bits)
        forms.push_back({.large_entries = (bits & 1) != 0,
                         .large_members = (bits & 2) != 0,
                         .large_end = (bits & 4) != 0,
                         .streamed = (bits & 8) != 0,
                         .deflated = (bits & 16) != 0});
    return forms;
}

/// Empty when the package is read; the bytes are in a block of their own size.
std::string refusal_of_zip(const std::string& bytes) {
    std::vector<std::byte> block(bytes.size());
    if (!bytes.empty()) std::memcpy(block.data(), bytes.data(), bytes.size());
    try {
        const tf::mesh_file file = tf::read(block, "a.3mf", "3mf");
        CHECK(file.mesh.faces.size() == 4);
        return {};
    } catch (const tf::io_error& e) {
        return e.what();
    }
}

std::string with_bytes(std::string bytes, std::size_t at, const std::string& changed) {
    return bytes.replace(at, changed.size(), changed);
}

const test::zip_form large{.large_entries = true, .large_members = true, .large_end = true};

}  // namespace

TEST_CASE("zip: sizes of 64 bits, streamed members, stored and deflated ones are read alike") {
    const std::string usual = test::package_3mf(packed_model);
    const tf::mesh_file plain = tf::read(std::as_bytes(std::span(usual)), "a.3mf", "3mf");
    CHECK(tf::signed_volume(plain.mesh) == doctest::Approx(1.0 / 6.0));
    for (const test::zip_form& form : all_zip_forms()) {
        CAPTURE(form.large_entries);
        CAPTURE(form.large_members);
        CAPTURE(form.large_end);
        CAPTURE(form.streamed);
        CAPTURE(form.deflated);
        const std::string bytes = test::package_3mf(packed_model, {}, form);
        CHECK(tf::read(std::as_bytes(std::span(bytes)), "a.3mf", {}).mesh == plain.mesh);
    }
}

TEST_CASE("zip: a member of many blocks, and a comment at the end, are read") {
    std::string spaces = packed_model;
    spaces.insert(spaces.find("<build>"), std::string(200000, ' '));
    CHECK(refusal_of_zip(test::package_3mf(spaces, {}, {.streamed = true, .deflated = true}))
              .empty());
    const std::string bytes = test::package_3mf(packed_model);
    const std::string comment = "PK\x05\x06, as an archive would end";
    CHECK(refusal_of_zip(bytes.substr(0, bytes.size() - 2) +
                         test::little_endian(comment.size(), 2) + comment)
              .empty());
}

TEST_CASE("zip: bytes ahead of an archive are passed over with a warning") {
    const std::string usual = test::package_3mf(packed_model);
    for (const test::zip_form& form : all_zip_forms())
        for (const std::string& ahead : {std::string("#!"), std::string(100000, 'x'), usual}) {
            const std::string bytes = ahead + test::package_3mf(packed_model, {}, form);
            const tf::mesh_file file = tf::read(std::as_bytes(std::span(bytes)), "a.3mf", {});
            CHECK(tf::signed_volume(file.mesh) == doctest::Approx(1.0 / 6.0));
            REQUIRE(file.warnings.size() == 1);
            CHECK(file.warnings[0].text ==
                  std::to_string(ahead.size()) + " bytes before the archive were skipped");
        }
}

TEST_CASE("zip: an archive of any form that is cut after any byte is refused") {
    for (const test::zip_form& form : all_zip_forms()) {
        const std::string whole = test::package_3mf(packed_model, {}, form);
        for (std::size_t size = 0; size < whole.size(); ++size)
            REQUIRE_FALSE(refusal_of_zip(whole.substr(0, size)).empty());
    }
}

TEST_CASE("zip: an archive of any form with any byte changed is read or refused by its name") {
    for (const test::zip_form& form : all_zip_forms()) {
        const std::string whole = test::package_3mf(packed_model, {}, form);
        for (std::size_t at = 0; at < whole.size(); ++at) {
            std::string bytes = whole;
            bytes[at] = static_cast<char>(~bytes[at]);
            const std::string said = refusal_of_zip(bytes);
            if (!said.empty()) REQUIRE(said.starts_with("a.3mf: "));
        }
    }
}

TEST_CASE("zip: a wrong count, size or place of ZIP64 is refused") {
    CHECK_FALSE(refusal_of_zip(test::package_3mf(packed_model, {}, {.more_counted = 1})).empty());
    test::zip_form form = large;
    form.more_counted = 1;
    CHECK_FALSE(refusal_of_zip(test::package_3mf(packed_model, {}, form)).empty());

    const std::string whole = test::package_3mf(packed_model, {}, large);
    REQUIRE(refusal_of_zip(whole).empty());
    const std::size_t end = whole.rfind("PK\x06\x06");
    const std::size_t locator = whole.rfind("PK\x06\x07");
    const std::size_t entry = whole.rfind("PK\x01\x02") + 46 + 16 + 4;  // of the model
    for (const std::string& number :
         {std::string(8, '\xff'), test::little_endian(0, 8), test::little_endian(whole.size(), 8),
          test::little_endian(1, 8), std::string(7, '\0') + '\x80'}) {
        for (const std::size_t at : {end + 32, end + 40, end + 48, locator + 8, entry, entry + 8})
            CHECK_FALSE(refusal_of_zip(with_bytes(whole, at, number)).empty());
    }
    CHECK(refusal_of_zip(with_bytes(whole, entry, std::string(7, '\xff') + '\x7f'))
              .find("announces") != std::string::npos);
}

TEST_CASE("zip: a directory that leaves values of ZIP64 out is refused") {
    const std::string whole = test::package_3mf(packed_model, {}, large);
    const std::size_t extra = whole.rfind("PK\x01\x02") + 46 + 16;
    for (const std::size_t size : {0UL, 8UL, 16UL, 23UL, 25UL, 65535UL})
        CHECK_FALSE(
            refusal_of_zip(with_bytes(whole, extra + 2, test::little_endian(size, 2))).empty());
    CHECK_FALSE(refusal_of_zip(with_bytes(whole, extra, test::little_endian(2, 2))).empty());
}

TEST_CASE("zip: members that share bytes, or have another's header, are refused") {
    const std::string whole = test::package_3mf(packed_model);
    const std::size_t entry = whole.rfind("PK\x01\x02");
    CHECK_FALSE(refusal_of_zip(with_bytes(whole, entry + 42, test::little_endian(0, 4))).empty());
    const std::size_t header = whole.rfind("PK\x03\x04");
    CHECK(refusal_of_zip(with_bytes(whole, header + 22, test::little_endian(7, 4)))
              .find("does not match") != std::string::npos);
    CHECK(refusal_of_zip(with_bytes(whole, header + 30, "4")).find("does not match") !=
          std::string::npos);
}

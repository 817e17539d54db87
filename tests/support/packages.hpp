#pragma once
/// \file
/// ZIP archives and 3MF packages, byte by byte, so that any byte may be wrong.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace test {

inline std::string little_endian(std::size_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 0xff);
    return text;
}

inline std::size_t crc32(const std::string& bytes) {
    std::uint32_t crc = ~0U;
    for (const char c : bytes) {
        crc ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ ((crc & 1) != 0 ? 0xedb88320U : 0U);
    }
    return ~crc;
}

/// A member that is stored as it is, and what the archive says of it.
struct zip_member {
    std::string name{};
    std::string bytes{};
    std::size_t flags = 0;
    std::size_t method = 0;
    std::size_t more_announced = 0;  ///< bytes that are not there
};

/// How an archive is written: as most are, or as programs do that do not know sizes beforehand.
struct zip_form {
    bool large_entries = false;  ///< ZIP64: sizes and places in extra fields of the directory
    bool large_members = false;  ///< ZIP64: sizes in extra fields of the members' headers
    bool large_end = false;      ///< ZIP64: an end record of its own
    bool streamed = false;       ///< sizes and checksum behind the bytes of a member, not before
    bool deflated = false;
    std::size_t more_counted = 0;  ///< members that are not there
};

/// As deflate has bytes that it does not pack: block by block.
inline std::string deflated(const std::string& bytes) {
    constexpr std::size_t longest = 65535;
    std::string blocks;
    for (std::size_t at = 0; at == 0 || at < bytes.size(); at += longest) {
        const std::string block = bytes.substr(at, longest);
        blocks += at + longest < bytes.size() ? '\0' : '\1';
        blocks += little_endian(block.size(), 2) + little_endian(~block.size(), 2) + block;
    }
    return blocks;
}

inline std::string zip_of(const std::vector<zip_member>& members, const zip_form& form = {}) {
    const std::string large(4, '\xff');
    std::string local;
    std::string directory;
    for (const zip_member& m : members) {
        const std::string bytes = form.deflated ? deflated(m.bytes) : m.bytes;
        const std::string place = little_endian(local.size(), 4);
        const std::string checksum = little_endian(crc32(m.bytes), 4);
        const std::size_t size = m.bytes.size() + m.more_announced;
        const std::string begin = little_endian(form.large_entries ? 45 : 20, 2) +
                                  little_endian(m.flags | (form.streamed ? 8 : 0), 2) +
                                  little_endian(form.deflated ? 8 : m.method, 2) +
                                  little_endian(0, 4);
        const auto sizes = [&](int digits) {
            return little_endian(bytes.size(), digits) + little_endian(size, digits);
        };
        const std::string both = little_endian(size, 8) + little_endian(bytes.size(), 8);
        const std::string in_entry =
            form.large_entries
                ? little_endian(1, 2) + little_endian(24, 2) + both + little_endian(local.size(), 8)
                : std::string();
        const std::string in_member = form.large_members
                                          ? little_endian(1, 2) + little_endian(16, 2) +
                                                (form.streamed ? std::string(16, '\0') : both)
                                          : std::string();
        directory += "PK\x01\x02" + little_endian(45, 2) + begin + checksum +
                     (form.large_entries ? large + large : sizes(4)) +
                     little_endian(m.name.size(), 2) + little_endian(in_entry.size(), 2) +
                     std::string(10, '\0') + (form.large_entries ? large : place) + m.name +
                     in_entry;
        local += "PK\x03\x04" + begin + (form.streamed ? std::string(4, '\0') : checksum) +
                 (form.large_members ? large + large
                  : form.streamed    ? std::string(8, '\0')
                                     : sizes(4)) +
                 little_endian(m.name.size(), 2) + little_endian(in_member.size(), 2) + m.name +
                 in_member + bytes;
        if (form.streamed) local += "PK\x07\x08" + checksum + sizes(form.large_members ? 8 : 4);
    }
    const std::size_t counted = members.size() + form.more_counted;
    std::string large_end;
    if (form.large_end)
        large_end = "PK\x06\x06" + little_endian(44, 8) + little_endian(45, 2) +
                    little_endian(45, 2) + std::string(8, '\0') + little_endian(counted, 8) +
                    little_endian(counted, 8) + little_endian(directory.size(), 8) +
                    little_endian(local.size(), 8) + "PK\x06\x07" + std::string(4, '\0') +
                    little_endian(local.size() + directory.size(), 8) + little_endian(1, 4);
    const std::string count = form.large_end ? "\xff\xff" : little_endian(counted, 2);
    return local + directory + large_end + "PK\x05\x06" + std::string(4, '\0') + count + count +
           (form.large_end ? large + large
                           : little_endian(directory.size(), 4) + little_endian(local.size(), 4)) +
           std::string(2, '\0');
}

/// What leads to a model part of that name.
inline zip_member relationships_to(const std::string& target) {
    return {.name = "_rels/.rels",
            .bytes =
                "<Relationships "
                "xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
                "<Relationship Target=\"" +
                target +
                "\" Id=\"r\" "
                "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>"
                "</Relationships>"};
}

/// A model part: `content` stands in its element <model>, `attributes` behind the name of that.
inline std::string model_text(const std::string& content, const std::string& attributes = {}) {
    return "<model xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" "
           "xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\" "
           "xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\"" +
           attributes + ">" + content + "</model>";
}

/// A package of one model part, or of more.
inline std::string package_3mf(const std::string& model, std::vector<zip_member> more = {},
                               const zip_form& form = {}) {
    std::vector<zip_member> members{relationships_to("/3D/3dmodel.model"),
                                    {.name = "3D/3dmodel.model", .bytes = model}};
    members.insert(members.end(), more.begin(), more.end());
    return zip_of(members, form);
}

/// A tetrahedron as a mesh of a model part.
inline const std::string tetrahedron_3mf =
    "<mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/>"
    "<vertex x=\"0\" y=\"1\" z=\"0\"/><vertex x=\"0\" y=\"0\" z=\"1\"/></vertices><triangles>"
    "<triangle v1=\"0\" v2=\"2\" v3=\"1\"/><triangle v1=\"0\" v2=\"1\" v3=\"3\"/>"
    "<triangle v1=\"1\" v2=\"2\" v3=\"3\"/><triangle v1=\"2\" v2=\"0\" v3=\"3\"/>"
    "</triangles></mesh>";

}  // namespace test

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

inline std::string zip_of(const std::vector<zip_member>& members) {
    std::string local;
    std::string directory;
    for (const zip_member& m : members) {
        const std::string about =
            little_endian(20, 2) + little_endian(m.flags, 2) + little_endian(m.method, 2) +
            little_endian(0, 4) + little_endian(crc32(m.bytes), 4) +
            little_endian(m.bytes.size(), 4) + little_endian(m.bytes.size() + m.more_announced, 4) +
            little_endian(m.name.size(), 2) + little_endian(0, 2);
        directory += "PK\x01\x02" + little_endian(20, 2) + about + std::string(10, '\0') +
                     little_endian(local.size(), 4) + m.name;
        local += "PK\x03\x04" + about + m.name + m.bytes;
    }
    const std::string count = little_endian(members.size(), 2);
    return local + directory + "PK\x05\x06" + std::string(4, '\0') + count + count +
           little_endian(directory.size(), 4) + little_endian(local.size(), 4) +
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
inline std::string package_3mf(const std::string& model, std::vector<zip_member> more = {}) {
    std::vector<zip_member> members{relationships_to("/3D/3dmodel.model"),
                                    {.name = "3D/3dmodel.model", .bytes = model}};
    members.insert(members.end(), more.begin(), more.end());
    return zip_of(members);
}

/// A tetrahedron as a mesh of a model part.
inline const std::string tetrahedron_3mf =
    "<mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/>"
    "<vertex x=\"0\" y=\"1\" z=\"0\"/><vertex x=\"0\" y=\"0\" z=\"1\"/></vertices><triangles>"
    "<triangle v1=\"0\" v2=\"2\" v3=\"1\"/><triangle v1=\"0\" v2=\"1\" v3=\"3\"/>"
    "<triangle v1=\"1\" v2=\"2\" v3=\"3\"/><triangle v1=\"2\" v2=\"0\" v3=\"3\"/>"
    "</triangles></mesh>";

}  // namespace test

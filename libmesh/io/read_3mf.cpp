#include <libmesh/io/parse_3mf.hpp>
#include <libmesh/io/place_3mf.hpp>
#include <libmesh/io/readers.hpp>
#include <libmesh/io/xml_part.hpp>
#include <libmesh/io/zip_archive.hpp>

#include <cstring>
#include <string>

namespace treeform::detail::io {

namespace {

constexpr const char* package_relationships = "_rels/.rels";

/// The model part that the package starts with.
[[nodiscard]] std::string root_of(const source& in, zip_archive& archive) {
    if (!archive.holds(package_relationships))
        in.fail("not a 3MF: the archive has no " + std::string(package_relationships));
    const xml_part relationships(in, package_relationships, archive.read(package_relationships));
    std::string root;
    for (const pugi::xml_node relationship : relationships.root().children()) {
        if (local_name(relationship.name()) != "Relationship") continue;
        if (std::strcmp(relationships.required(relationship, "Type"), model_relationship_3mf) != 0)
            continue;
        if (!root.empty()) relationships.fail(relationship, "is a second root model");
        root = relationships.required(relationship, "Target");
        if (root.starts_with('/')) root.erase(0, 1);
        if (!archive.holds(root))
            relationships.fail(relationship, "refers to a file that is not in the archive");
    }
    if (root.empty()) relationships.fail("no relationship refers to a model: not a 3MF");
    return root;
}

}  // namespace

mesh_file read_3mf(const source& in) {
    zip_archive archive(in);
    const std::string root = root_of(in, archive);
    mesh_file file = place_3mf(in, parse_3mf(in, archive, root));
    if (archive.bytes_ahead() > 0)
        file.warnings.push_back({"bytes-ahead", std::to_string(archive.bytes_ahead()) +
                                                    " bytes before the archive were skipped"});
    return file;
}

}  // namespace treeform::detail::io

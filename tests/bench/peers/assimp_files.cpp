#include "bench/peers/assimp_files.hpp"

#include "bench/peers/versions.hpp"

#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#include <assimp/version.h>

#include <stdexcept>

namespace treeform::bench {
namespace {

void append(const aiMesh& part, mesh& mesh) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (unsigned v = 0; v < part.mNumVertices; ++v)
        mesh.points.push_back({part.mVertices[v].x, part.mVertices[v].y, part.mVertices[v].z});
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
        const aiFace& face = part.mFaces[f];
        if (face.mNumIndices == 3)
            mesh.faces.push_back(
                {first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
    }
}

/// A scene of one node and one mesh.
std::shared_ptr<const aiScene> scene_of(const mesh& mesh) {
    auto scene = std::make_shared<aiScene>();
    scene->mRootNode = new aiNode;  // the scene owns it and all below
    scene->mRootNode->mNumMeshes = 1;
    scene->mRootNode->mMeshes = new unsigned[1]{0};
    scene->mNumMaterials = 1;
    scene->mMaterials = new aiMaterial* [1] { new aiMaterial };
    scene->mNumMeshes = 1;
    scene->mMeshes = new aiMesh* [1] { new aiMesh };
    aiMesh& part = *scene->mMeshes[0];
    part.mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
    part.mNumVertices = static_cast<unsigned>(mesh.points.size());
    part.mVertices = new aiVector3D[part.mNumVertices];
    for (unsigned v = 0; v < part.mNumVertices; ++v) {
        const point3& p = mesh.points[v];
        part.mVertices[v] = {static_cast<ai_real>(p.x), static_cast<ai_real>(p.y),
                             static_cast<ai_real>(p.z)};
    }
    part.mNumFaces = static_cast<unsigned>(mesh.faces.size());
    part.mFaces = new aiFace[part.mNumFaces];
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
        part.mFaces[f].mNumIndices = 3;
        part.mFaces[f].mIndices =
            new unsigned[3]{mesh.faces[f][0], mesh.faces[f][1], mesh.faces[f][2]};
    }
    return scene;
}

}  // namespace

assimp_scene assimp_read(const std::string& path) {
    auto importer = std::make_shared<Assimp::Importer>();
    if (importer->ReadFile(path, 0) == nullptr)
        throw std::runtime_error(std::string("assimp: ") + importer->GetErrorString());
    return importer;
}

mesh mesh_of(const assimp_scene& scene) {
    mesh mesh;
    for (unsigned m = 0; m < scene->GetScene()->mNumMeshes; ++m)
        append(*scene->GetScene()->mMeshes[m], mesh);
    return mesh;
}

std::function<void()> assimp_writer(const mesh& mesh, const std::string& path,
                                    const file_kind& kind) {
    return [scene = scene_of(mesh), path, id = kind.assimp_id] {
        Assimp::Exporter exporter;
        if (exporter.Export(scene.get(), id, path) != aiReturn_SUCCESS)
            throw std::runtime_error(std::string("assimp: ") + exporter.GetErrorString());
    };
}

std::string assimp_name() {
    return "assimp " + std::to_string(aiGetVersionMajor()) + "." +
           std::to_string(aiGetVersionMinor()) + "." + std::to_string(aiGetVersionPatch());
}

}  // namespace treeform::bench

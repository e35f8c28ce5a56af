#include <algorithm>
#include <osg/Material>
#include <osg/TexGen>
#include <vector>

#include "viewer/node_look.h"
#include "viewer/soil_looks.h"

namespace divot::viewer {
namespace {

// Soil looks freshly turned from this sinkage on, in spacings.
constexpr float kTurned = 0.15f;
// Freshly turned soil over untouched, where a material has a colour of its own.
constexpr float kTurnedTone = 0.6f;

// Colours of vertices and of glColor reach the application's lights.
void take_colors(osg::StateSet& state) {
  osg::ref_ptr<osg::Material> material = new osg::Material;
  material->setColorMode(osg::Material::AMBIENT_AND_DIFFUSE);
  material->setSpecular(osg::Material::FRONT_AND_BACK, {0, 0, 0, 1});
  state.setAttributeAndModes(material);
}

class ApplicationStyle : public NodeStyle {
 public:
  ApplicationStyle(TerrainNode& terrain, osg::Group& bodies, const WorldNodeOptions& options)
      : soil_(options.soil), turned_(options.turned), root_(new osg::Group) {
    osg::ref_ptr<osg::Group> ground = new osg::Group;
    ground->addChild(&terrain.ground());
    take_colors(*ground->getOrCreateStateSet());
    root_->addChild(ground);

    osg::ref_ptr<osg::Group> balls = new osg::Group;
    balls->addChild(&bodies);
    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setAmbient(osg::Material::FRONT_AND_BACK, options.body);
    material->setDiffuse(osg::Material::FRONT_AND_BACK, options.body);
    balls->getOrCreateStateSet()->setAttributeAndModes(material);
    // Balls are a unit sphere made larger, and their normals with it.
    balls->getOrCreateStateSet()->setMode(GL_NORMALIZE, osg::StateAttribute::ON);
    root_->addChild(balls);
  }

  // Pictures are laid over the ground by its coordinates. What an untouched and a turned vertex's colour is, is kept.
  std::vector<osg::ref_ptr<osg::StateSet>> looks(std::span<const Material> materials,
                                                 const std::string& folder) override {
    std::vector<osg::ref_ptr<osg::StateSet>> states;
    for (const Material& material : materials) {
      states.push_back(new osg::StateSet);
      tones_.push_back({soil_, turned_});
      const auto texture = texture_of(material, folder);
      if (!texture && material.color.empty()) continue;
      const osg::Vec3 own = texture ? osg::Vec3(1, 1, 1) : color_of(material.color);
      tones_.back() = {osg::Vec4(own, 1), osg::Vec4(own * kTurnedTone, 1)};
      if (!texture) continue;
      osg::ref_ptr<osg::TexGen> over = new osg::TexGen;
      over->setMode(osg::TexGen::OBJECT_LINEAR);
      over->setPlane(osg::TexGen::S, {1 / material.texture_size, 0, 0, 0});
      over->setPlane(osg::TexGen::T, {0, 1 / material.texture_size, 0, 0});
      states.back()->setTextureAttributeAndModes(0, texture);
      states.back()->setTextureAttributeAndModes(0, over);
    }
    return states;
  }

  void update(const Snapshot& snapshot, TerrainNode& terrain) override {
    const auto deep = kTurned * static_cast<float>(snapshot.surface.spacing);
    seen_.resize(terrain.ground().getNumChildren());
    for (unsigned i = 0; i < seen_.size(); ++i) {
      const std::uint8_t material = terrain.ground_materials()[i];
      const Tones tones = material < tones_.size() ? tones_[material] : Tones{soil_, turned_};
      color(*terrain.ground().getChild(i)->asGeometry(), tones, deep, seen_[i]);
    }
  }

  osg::Node& root() override { return *root_; }

 private:
  struct Tones {
    osg::Vec4 soil, turned;
  };

  // What a chunk's colours were made from.
  struct Seen {
    const osg::Array* sinkage = nullptr;
    unsigned version = 0;
  };

  // Chunks count their changes; only those that changed are coloured again.
  static void color(osg::Geometry& chunk, const Tones& tones, float deep, Seen& seen) {
    const auto& sinkage = static_cast<const osg::Vec2Array&>(*chunk.getVertexAttribArray(kSinkageAttribute));
    auto* colors = static_cast<osg::Vec4ubArray*>(chunk.getColorArray());
    const bool is_colored = colors != nullptr && seen.sinkage == &sinkage;
    if (is_colored && seen.version == sinkage.getModifiedCount()) return;
    seen = {&sinkage, sinkage.getModifiedCount()};
    if (colors == nullptr) {
      colors = new osg::Vec4ubArray(osg::Array::BIND_PER_VERTEX, static_cast<unsigned>(sinkage.size()));
      colors->setNormalize(true);
      chunk.setColorArray(colors);
    }
    for (std::size_t v = 0; v < sinkage.size(); ++v) {
      const float share = std::clamp(sinkage[v].y() / deep, 0.0f, 1.0f);
      const osg::Vec4 mixed = (tones.soil * (1 - share) + tones.turned * share) * 255.0f;
      for (int channel = 0; channel < 4; ++channel) {
        (*colors)[v][channel] = static_cast<unsigned char>(std::clamp(mixed[channel] + 0.5f, 0.0f, 255.0f));
      }
    }
    colors->dirty();
  }

  osg::Vec4 soil_, turned_;
  std::vector<Tones> tones_;  // [material]
  std::vector<Seen> seen_;    // [child of the ground]
  osg::ref_ptr<osg::Group> root_;
};

}  // namespace

std::unique_ptr<NodeStyle> make_application_style(TerrainNode& terrain, osg::Group& bodies,
                                                  const WorldNodeOptions& options) {
  return std::make_unique<ApplicationStyle>(terrain, bodies, options);
}

}  // namespace divot::viewer

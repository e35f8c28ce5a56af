#include <osgUtil/CullVisitor>

#include "viewer/lit_view.h"
#include "viewer/node_look.h"
#include "viewer/soil_looks.h"

namespace divot::viewer {
namespace {

constexpr double kNoHaze = 1e9;       // m: the air is the application's
constexpr float kDetailWaves = 5;     // longest waves of colour across the terrain
constexpr double kShadowReach = 0.6;  // of the terrain's diagonal, from its centre

// The shaders take the inverse of the view for the way back from the eye to the surface's coordinates. Below the
// transforms of an application that is the inverse of model and view.
struct ViewInverse : osg::NodeCallback {
  osg::ref_ptr<osg::Uniform> uniform = new osg::Uniform("osg_ViewMatrixInverse", osg::Matrixf());
  void operator()(osg::Node* node, osg::NodeVisitor* visitor) override {
    if (auto* cull = visitor->asCullVisitor()) {
      uniform->set(osg::Matrixf(osg::Matrixd::inverse(*cull->getModelViewMatrix())));
    }
    traverse(node, visitor);
  }
};

class DivotStyle : public NodeStyle {
 public:
  DivotStyle(TerrainNode& terrain, BodyNode& bodies)
      : view_({terrain.ground(), *walls_, bodies.root(), bodies.solids(), *bombs_}, Sun{}, Quality::fine) {
    // The last child of a lit view is its sky.
    osg::Group& root = view_.root();
    root.removeChild(root.getNumChildren() - 1);
    osg::ref_ptr<ViewInverse> inverse = new ViewInverse;
    root.setCullCallback(inverse);
    osg::StateSet* state = root.getOrCreateStateSet();
    state->setDataVariance(osg::Object::DYNAMIC);
    for (const auto& uniform : {inverse->uniform, height_range_, detail_wave_, sinkage_scale_}) {
      uniform->setDataVariance(osg::Object::DYNAMIC);
      state->addUniform(uniform);
    }
  }

  std::vector<osg::ref_ptr<osg::StateSet>> looks(std::span<const Material> materials,
                                                 const std::string& folder) override {
    return soil_looks(materials, folder);
  }

  void update(const Snapshot& snapshot, TerrainNode& terrain) override {
    if (!placed_) place(snapshot.surface, terrain);
    placed_ = true;
    view_.lighting().set_occluders(snapshot.surface.origin, snapshot.bodies);
    view_.lighting().renew_shadows();
  }

  osg::Node& root() override { return view_.root(); }

 private:
  void place(const SurfaceView& surface, const TerrainNode& terrain) {
    const Region& all = terrain.bounds();
    const Vec3d center = all.center() - surface.origin;
    view_.lighting().set_focus({center.x, center.y, center.z}, kShadowReach * length(all.max - all.min));
    view_.lighting().set_haze(kNoHaze);
    const float relief = terrain.highest() - terrain.lowest();
    height_range_->set(osg::Vec2(terrain.lowest(), relief > 0 ? 1 / relief : 0.0f));
    detail_wave_->set(static_cast<float>(all.extent()) / kDetailWaves);
    sinkage_scale_->set(static_cast<float>(surface.spacing));
  }

  osg::ref_ptr<osg::Group> walls_ = new osg::Group, bombs_ = new osg::Group;  // stay empty
  LitView view_;
  osg::ref_ptr<osg::Uniform> height_range_ = new osg::Uniform("height_range", osg::Vec2());
  osg::ref_ptr<osg::Uniform> detail_wave_ = new osg::Uniform("detail_wave", 1.0f);
  osg::ref_ptr<osg::Uniform> sinkage_scale_ = new osg::Uniform("sinkage_scale", 1.0f);
  bool placed_ = false;
};

}  // namespace

std::unique_ptr<NodeStyle> make_divot_style(TerrainNode& terrain, BodyNode& bodies) {
  return std::make_unique<DivotStyle>(terrain, bodies);
}

}  // namespace divot::viewer

#pragma once

// The whole public interface.
#include "divot/blast.h"
#include "divot/errors.h"
#include "divot/ids.h"
#include "divot/jobs.h"
#include "divot/joint.h"
#include "divot/material.h"
#include "divot/recording.h"
#include "divot/scene.h"
#include "divot/settings.h"
#include "divot/shape.h"
#include "divot/vec.h"
#include "divot/version.h"
#include "divot/views.h"
#include "divot/world.h"

#pragma once

/// Everything, in pipeline order.
#include "probegi/backend.h"
#include "probegi/builtin_scenes.h"
#include "probegi/context.h"
#include "probegi/edits.h"
#include "probegi/field.h"
#include "probegi/image.h"
#include "probegi/io.h"
#include "probegi/measure.h"
#include "probegi/reference.h"
#include "probegi/render.h"
#include "probegi/result.h"
#include "probegi/scene.h"
#include "probegi/shapes.h"
#include "probegi/snapshot.h"
#include "probegi/tracer.h"
#include "probegi/volume.h"

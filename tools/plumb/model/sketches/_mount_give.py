"""Mount give: brackets, ring and shaft yield along the chain in step with its tension.

Set aside by the underscore; as mount_give.py it is ranked and fitted.
"""

from plumb.model.sketches import Sketch, SketchParameter, Strands
from plumb.model.sketches.sketch import Array


def extra(parameters: Array, strands: Strands) -> Array:
    """Return the added chain (n, 2) [mm]: mounts that yield by give * tension need less chain by as
    much.
    """
    return -float(parameters[0]) * strands.tension


SKETCH = Sketch(
    name="mount_give",
    summary="brackets, ring and motor shafts yield along the chain in step with its tension",
    pattern="marks hang low, most at the top where both chains pull hardest",
    look_alikes="frame_flex, chain_stretch",
    remedy="pull at the chain next to the sprocket with a luggage scale and see how far all of it "
    "comes towards you",
    parameters=(SketchParameter("give", "mm/N", 0.0, 0.05, 0.005, "give of all mounts of a side"),),
    extra=extra,
)

"""Mount give: brackets, ring and shaft yield along the chain in step with its tension.

Set aside by the underscore; as mount_give.py it is ranked and fitted.
"""

from plumb.model.sketches import Sketch, SketchParameter


def extra(parameters, strands):
    """Chain more (n, 2) [mm]: what yields by give * tension spares the chain as much."""
    return -parameters[0] * strands.tension


SKETCH = Sketch(
    name="mount_give",
    summary="brackets, ring and motor shafts yield along the chain in step with its tension",
    pattern="marks hang low, most at the top where both chains pull hardest",
    look_alikes="frame_flex, chain_stretch",
    remedy="pull at the chain beside the sprocket with a luggage scale and see how far all of it "
    "comes towards you",
    parameters=(
        SketchParameter("give", "mm/N", 0.0, 0.05, 0.005, "give of one side's mounts together"),
    ),
    extra=extra,
)

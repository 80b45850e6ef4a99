"""A machine on the page of a lab: virtual, its bar; and a board that is only said to be there."""

import json

PATIENCE = 300_000  # [ms] of a busy computer
AT_REST = {"kind": "board", "name": "/dev/ttyACM0", "phase": "ready"}


def start_virtual(page, lab, *, speed=1000, number=None):
    """Open the lab, start a virtual machine, of this number or drawn, and read its settings."""
    page.goto(lab.url)
    page.get_by_label("and cuts").select_option(str(speed))
    if number is not None:
        page.get_by_text("A certain machine").click()
        page.get_by_label("Its number").fill(str(number))
    page.get_by_role("button", name="Start a virtual machine").click()
    page.get_by_role("heading", name="This machine is open").wait_for()


def bar(page):
    """The line of the machine, in view on all screens."""
    return page.get_by_role("region", name="The machine", exact=True)


def with_machine(page, **state):
    """Whatever the lab says of its machine, the page hears this."""

    def heard(line):
        server = line.connect_to_server()

        def changed(message):
            said = json.loads(message)
            line.send(json.dumps({**said, **AT_REST, **state} if "kind" in said else said))

        server.on_message(changed)

    page.route_web_socket("**/api/live*", heard)

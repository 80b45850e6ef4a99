"""Faults and long jobs on the virtual machine: what a machine does when something goes wrong."""

"""Friction monitoring: from the rig's readings over time to apparent friction factors and alarms."""

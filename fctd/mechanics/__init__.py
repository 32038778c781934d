"""The compiled mechanics: state, joints, contact, friction, top drive and the step that calls them."""

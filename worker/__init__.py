"""What makes pictures: jobs at the door, synthesis and rendering behind it."""

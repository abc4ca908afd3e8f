def test_the_bare_address_leads_to_the_documentation(client):
    answer = client.get("/", follow_redirects=False)

    assert (answer.status_code, answer.headers["location"]) == (307, "/docs")
    assert client.get("/docs").headers["content-type"].startswith("text/html")
